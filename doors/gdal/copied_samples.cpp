// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/copied_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "doors/gdal/copied_voids.hpp"
#include "doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// Doubles by rows, so that the copy is the only large array. Voids are told as doubles: -DBL_MAX,
/// a common one, is beyond the floats.
class DoubleRows {
 public:
  DoubleRows(GDALRasterBand& band, float* out) : band_(band), out_(out), nodata_(nodataOf(band)) {}

  bool read(const ProgressPart& progress) {
    const int width = band_.GetXSize(), height = band_.GetYSize();
    std::vector<double> row(static_cast<size_t>(width));
    std::vector<GByte> mask(row.size(), 255);
    const bool masked = hasMask(band_);
    for (int y = 0; y < height; ++y) {
      if (band_.RasterIO(GF_Read, 0, y, width, 1, row.data(), width, 1, GDT_Float64, 0, 0,
                         nullptr) != CE_None ||
          (masked && band_.GetMaskBand()->RasterIO(GF_Read, 0, y, width, 1, mask.data(), width, 1,
                                                   GDT_Byte, 0, 0, nullptr) != CE_None) ||
          !progress.report(double(y + 1) / height))
        return false;
      for (size_t x = 0; x < row.size(); ++x) *out_++ = narrowed(row[x], mask[x] != 0);
    }
    return true;
  }
  /// The largest of any sample that is not void.
  double rounding() const { return rounding_; }

 private:
  float narrowed(double value, bool valid) {
    if (nodata_ && nearlyEqual(value, *nodata_)) return floatNodata(*nodata_);
    const float rounded = toFloat(value);
    if (valid && std::isfinite(rounded))
      rounding_ = std::max(rounding_, std::abs(value - static_cast<double>(rounded)));
    return rounded;
  }

  /// Beyond the floats: infinity, which tks_encode refuses with its place.
  static float toFloat(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (std::isfinite(value) && std::abs(value) > kLargest)
      return std::copysign(std::numeric_limits<float>::infinity(), value < 0 ? -1.0F : 1.0F);
    return static_cast<float>(value);
  }

  GDALRasterBand& band_;
  float* out_;
  std::optional<double> nodata_;
  double rounding_ = 0;
};

/// A failure that GDAL has not reported is the user's who stops.
bool reportStop(const std::string& name) {
  if (CPLGetLastErrorType() < CE_Failure)
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
  return false;
}

}  // namespace

std::optional<tks_sample> sampleOf(GDALRasterBand& band) {
  switch (band.GetRasterDataType()) {
    case GDT_Byte: {
      const char* const type = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
      return type != nullptr && EQUAL(type, "SIGNEDBYTE") ? TKS_I8 : TKS_U8;
    }
#if GDAL_VERSION_NUM >= 3070000
    case GDT_Int8:
      return TKS_I8;
#endif
    case GDT_UInt16:
      return TKS_U16;
    case GDT_Int16:
      return TKS_I16;
    case GDT_UInt32:
      return TKS_U32;
    case GDT_Int32:
      return TKS_I32;
    case GDT_Float32:
    case GDT_Float64:
      return TKS_F32;
    default:
      return std::nullopt;
  }
}

bool readSamples(const std::string& name, GDALRasterBand& band, bool strict, CopiedHeights& copy,
                 const ProgressPart& progress) {
  const int width = band.GetXSize(), height = band.GetYSize();
  copy.samples.resize(size_t(width) * size_t(height) * tks_sample_bytes(copy.heights.sample));
  CPLErrorReset();
  if (band.GetRasterDataType() != GDT_Float64) {
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.pfnProgress = ProgressPart::call;
    extra.pProgressData = const_cast<ProgressPart*>(&progress);
    return band.RasterIO(GF_Read, 0, 0, width, height, copy.samples.data(), width, height,
                         band.GetRasterDataType(), 0, 0, &extra) == CE_None ||
           reportStop(name);
  }
  DoubleRows rows(band, reinterpret_cast<float*>(copy.samples.data()));
  if (!rows.read(progress)) return reportStop(name);
  copy.rounding = rows.rounding();
  if (copy.rounding == 0) return true;
  if (strict) {
    reportFailure(TKS_USAGE, name,
                  "The samples are Float64 and no Float32 holds all of them; "
                  "convert them first.");
    return false;
  }
  CPLError(CE_Warning, CPLE_AppDefined,
           "%s: Float64 samples are rounded to Float32, by up to %.2g.", name.c_str(),
           copy.rounding);
  return true;
}

}  // namespace tetrakis::gdal
