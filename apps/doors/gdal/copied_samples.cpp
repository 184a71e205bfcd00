// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/copied_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "apps/doors/gdal/copied_voids.hpp"
#include "apps/doors/gdal/source.hpp"
#include "base/nodata.hpp"

namespace tetrakis::gdal {
namespace {

/// Doubles by rows, so that the copy is the only large array. Voids are told as doubles: -DBL_MAX,
/// a common one, is beyond the floats. What stands for them: base/nodata.hpp.
class DoubleRows {
 public:
  DoubleRows(GDALRasterBand& band, std::span<float> out)
      : band_(band), out_(out), nodata_(nodataOf(band)) {}

  bool read(const ProgressPart& progress) {
    const size_t width = band_.GetXSize(), height = band_.GetYSize();
    const int columns = band_.GetXSize();
    std::vector<double> row(width);
    std::vector<GByte> mask(width, 255);
    const bool masked = hasMask(band_);
    for (size_t y = 0; y < height; ++y) {
      const int line = static_cast<int>(y);
      if (band_.RasterIO(GF_Read, 0, line, columns, 1, row.data(), columns, 1, GDT_Float64, 0, 0,
                         nullptr) != CE_None ||
          (masked &&
           band_.GetMaskBand()->RasterIO(GF_Read, 0, line, columns, 1, mask.data(), columns, 1,
                                         GDT_Byte, 0, 0, nullptr) != CE_None) ||
          !progress.report(double(y + 1) / double(height)))
        return false;
      for (size_t x = 0; x < width; ++x) out_[y * width + x] = narrowed(row[x], mask[x] != 0);
    }
    if (nodata_ && !merged_)
      std::replace_if(
          out_.begin(), out_.end(), [](float sample) { return std::isnan(sample); }, mark_);
    return true;
  }
  /// The largest of any sample that is not void.
  double rounding() const { return rounding_; }
  /// What stands for voids, if any value does.
  std::optional<double> nodata() const {
    if (!nodata_) return std::nullopt;
    return double{merged_ ? kNaN : mark_};
  }

 private:
  static constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

  /// NaN for voids, until all samples are known.
  float narrowed(double value, bool valid) {
    if (nodata_ && meetsNodata(value, *nodata_)) return kNaN;
    const float rounded = toFloat(value);  // an infinity is refused by tks_encode with its place
    if (!valid || !std::isfinite(rounded)) return rounded;
    merged_ = merged_ || meetsNodata(rounded, mark_);
    rounding_ = std::max(rounding_, std::abs(value - static_cast<double>(rounded)));
    return rounded;
  }

  GDALRasterBand& band_;
  std::span<float> out_;
  std::optional<double> nodata_;
  float mark_ = nodata_ ? narrowedNodata(*nodata_) : kNaN;
  bool merged_ = false;  ///< a sample that is not void has become what meets the mark
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
  DoubleRows rows(
      band, {reinterpret_cast<float*>(copy.samples.data()), copy.samples.size() / sizeof(float)});
  if (!rows.read(progress)) return reportStop(name);
  copy.heights.has_nodata = rows.nodata().has_value();
  copy.heights.nodata = rows.nodata().value_or(0);
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
