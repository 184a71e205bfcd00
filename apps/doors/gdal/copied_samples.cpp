// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/copied_samples.hpp"

#include <cmath>
#include <span>

#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// By rows, so that the copy is the only large array.
bool readDoubles(NarrowedBand& band, uint32_t width, uint32_t height, std::span<float> out,
                 const ProgressPart& progress) {
  for (uint32_t y = 0; y < height; ++y) {
    if (!band.read({0, y, width, 1}, out.subspan(size_t{y} * width, width)) ||
        !progress.report(double(y + 1) / double(height)))
      return false;
  }
  band.mark(out);
  return true;
}

}  // namespace

bool reportStop(const std::string& name) {
  if (CPLGetLastErrorType() < CE_Failure)
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
  return false;
}

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
  NarrowedBand doubles(band);
  const std::span<float> floats(reinterpret_cast<float*>(copy.samples.data()),
                                copy.samples.size() / sizeof(float));
  if (!readDoubles(doubles, copy.heights.width, copy.heights.height, floats, progress))
    return reportStop(name);
  return takeNarrowed(name, doubles, strict, copy);
}

bool takeNarrowed(const std::string& name, const NarrowedBand& doubles, bool strict,
                  CopiedHeights& copy) {
  copy.heights.has_nodata = doubles.nodata().has_value();
  copy.heights.nodata = doubles.nodata().value_or(0);
  copy.rounding = doubles.rounding();
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

std::optional<double> boundOf(const std::string& name, const CopiedHeights* heights,
                              double max_z_error) {
  if (max_z_error == 0 || heights == nullptr) return 0;
  const double left = max_z_error - heights->rounding;
  if (!(left > 0)) {
    reportFailure(TKS_USAGE, name,
                  CPLSPrintf("The samples are Float64, and Float32 holds them within %.2g only, "
                             "which MAX_Z_ERROR=%.12g does not allow.",
                             heights->rounding, max_z_error));
    return std::nullopt;
  }
  // GDAL counts in samples.
  return left * std::abs(heights->heights.scale);
}

}  // namespace tetrakis::gdal
