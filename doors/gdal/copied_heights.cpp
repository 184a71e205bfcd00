// SPDX-License-Identifier: Apache-2.0
// A band of GDAL as heights. Voids and spacing follow the command line (tools/files), whose files
// GDAL writes and reads too.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <type_traits>

#include "doors/gdal/copied_raster.hpp"
#include "doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// Of the samples that a stream takes; doubles are read as floats.
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

template <class Visitor>
auto visit(CopiedHeights& copy, const Visitor& visitor) {
  const auto as = [&]<class T>(T) {
    return visitor(
        std::span(reinterpret_cast<T*>(copy.samples.data()), copy.samples.size() / sizeof(T)));
  };
  switch (copy.heights.sample) {
    case TKS_U8:
      return as(uint8_t{});
    case TKS_I8:
      return as(int8_t{});
    case TKS_U16:
      return as(uint16_t{});
    case TKS_I16:
      return as(int16_t{});
    case TKS_U32:
      return as(uint32_t{});
    case TKS_I32:
      return as(int32_t{});
    case TKS_F32:
      break;
  }
  return as(float{});
}

/// As GDAL compares samples with a nodata value.
template <class T>
bool nearlyEqual(T sample, T nodata) {
  constexpr T kRelative = 2 * std::numeric_limits<float>::epsilon();
  return sample == nodata || std::abs(sample - nodata) < kRelative * std::abs(sample + nodata);
}

/// Nothing if the band declares none.
std::optional<double> nodataOf(GDALRasterBand& band) {
  int has_nodata = FALSE;
  const double nodata = band.GetNoDataValue(&has_nodata);
  return has_nodata ? std::optional(nodata) : std::nullopt;
}

/// A nodata value as floats hold it.
float floatNodata(double nodata) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(nodata) ? std::clamp(nodata, -kLargest, kLargest)
                                                  : nodata);
}

/// A mask that is more than the nodata value.
bool hasMask(GDALRasterBand& band) {
  return (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

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

/// Declares the nodata value; floats that GDAL takes for it become it.
void takeNodata(GDALRasterBand& band, CopiedHeights& copy) {
  const std::optional<double> nodata = nodataOf(band);
  if (!nodata) return;
  copy.heights.has_nodata = 1;
  copy.heights.nodata = *nodata;
  if (copy.heights.sample == TKS_F32) {
    const float value = floatNodata(*nodata);
    copy.heights.nodata = value;
    auto* const samples = reinterpret_cast<float*>(copy.samples.data());
    for (size_t i = 0; i < copy.samples.size() / sizeof(float); ++i)
      if (nearlyEqual(samples[i], value)) samples[i] = value;
  }
}

/// The outermost value that no valid sample has, of the 65536 at the end of the type's range where
/// heights are least likely.
template <class T>
std::optional<double> freeValue(std::span<T> samples, const std::vector<GByte>& mask) {
  using Limits = std::numeric_limits<T>;
  const auto rank = [](T value) {
    return std::is_signed_v<T> ? static_cast<uint64_t>(int64_t{value} - int64_t{Limits::min()})
                               : static_cast<uint64_t>(Limits::max() - value);
  };
  const uint64_t range = rank(std::is_signed_v<T> ? Limits::max() : Limits::min()) + 1;
  std::vector<bool> taken(std::min<uint64_t>(range, 65536));
  for (size_t i = 0; i < samples.size(); ++i)
    if (mask[i] != 0 && rank(samples[i]) < taken.size()) taken[rank(samples[i])] = true;
  const auto found = std::find(taken.begin(), taken.end(), false);
  if (found == taken.end()) return std::nullopt;
  const auto free = static_cast<double>(found - taken.begin());
  return std::is_signed_v<T> ? double{Limits::min()} + free : double{Limits::max()} - free;
}

template <class T>
bool holds(double value) {
  if constexpr (!std::is_integral_v<T>) return true;
  return value == std::trunc(value) && value >= double(std::numeric_limits<T>::min()) &&
         value <= double(std::numeric_limits<T>::max());
}

/// Samples that a mask band leaves out become the nodata value; one is chosen if there is none.
bool applyMask(const std::string& name, GDALRasterBand& band, CopiedHeights& copy) {
  if (!hasMask(band)) return true;
  const int width = band.GetXSize(), height = band.GetYSize();
  std::vector<GByte> mask(size_t(width) * size_t(height));
  if (band.GetMaskBand()->RasterIO(GF_Read, 0, 0, width, height, mask.data(), width, height,
                                   GDT_Byte, 0, 0, nullptr) != CE_None)
    return false;
  if (std::find(mask.begin(), mask.end(), 0) == mask.end()) return true;
  tks_heights& heights = copy.heights;
  const bool applied = visit(copy, [&]<class T>(std::span<T> samples) {
    std::optional<double> value;
    if (heights.has_nodata && holds<T>(heights.nodata)) value = heights.nodata;
    if constexpr (std::is_integral_v<T>) {
      if (!value) value = freeValue(samples, mask);
    } else if (!value) {
      value = std::numeric_limits<double>::quiet_NaN();
    }
    if (!value) return false;
    for (size_t i = 0; i < samples.size(); ++i)
      if (mask[i] == 0) samples[i] = static_cast<T>(*value);
    heights.has_nodata = 1;
    heights.nodata = *value;
    return true;
  });
  if (!applied)
    reportFailure(TKS_USAGE, name,
                  "The mask needs a nodata value, and the samples take all of "
                  "them; convert them to a wider type.");
  return applied;
}

/// A copy that need not be strict declares what files write where they have no height, as
/// gdal_translate -a_nodata would.
void takeFill(const std::string& name, CopiedHeights& copy) {
  tks_outliers found{sizeof found, 0, 0, 0};
  if (tks_find_outliers(&copy.heights, &found) != TKS_OK || found.is_fill == 0) return;
  copy.heights.has_nodata = 1;
  copy.heights.nodata = found.value;
  CPLError(CE_Warning, CPLE_AppDefined,
           "%s: %llu samples are %.9g, far from all others: declared as nodata (not by a strict "
           "copy).",
           name.c_str(), static_cast<unsigned long long>(found.count), found.value);
}

/// Metres per degree east and north at a latitude on WGS 84, as tools/files/place/earth.hpp.
void groundSpacing(const OGRSpatialReference* system, tks_heights& heights) {
  if (system == nullptr || !heights.has_geotransform || system->IsLocal()) return;
  const double* const t = heights.geotransform;
  double east = system->GetLinearUnits(), north = east;
  if (system->IsGeographic()) {
    constexpr double kAxis = 6378137.0, kFlattening = 1 / 298.257223563;
    constexpr double kE2 = kFlattening * (2 - kFlattening);
    const double radians = system->GetAngularUnits();
    const double latitude =
        (t[3] + heights.width / 2.0 * t[4] + heights.height / 2.0 * t[5]) * radians;
    if (!(std::abs(latitude) < std::numbers::pi / 2)) return;
    const double w = std::sqrt(1 - kE2 * std::sin(latitude) * std::sin(latitude));
    east = radians * kAxis / w * std::cos(latitude);
    north = radians * kAxis * (1 - kE2) / (w * w * w);
  } else if (!system->IsProjected()) {
    return;
  }
  const double x = std::hypot(t[1] * east, t[4] * north), y = std::hypot(t[2] * east, t[5] * north);
  if (!std::isfinite(x) || !std::isfinite(y) || x <= 0 || y <= 0) return;
  heights.spacing_x = x;
  heights.spacing_y = y;
}

/// A scale of 0 would make all heights one.
double scaleOf(const std::string& name, GDALRasterBand& band) {
  const double scale = band.GetScale();
  if (scale != 0 && std::isfinite(scale)) return scale;
  CPLError(CE_Warning, CPLE_AppDefined, "%s: A scale of %g is none and is left out.", name.c_str(),
           scale);
  return 1;
}

/// What the dataset says of its band, but for voids.
void takeFacts(const std::string& name, GDALDataset& dataset, CopiedHeights& copy) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  tks_heights& heights = copy.heights;
  heights.scale = scaleOf(name, band);
  heights.offset = band.GetOffset();
  copy.unit = band.GetUnitType() != nullptr ? band.GetUnitType() : "";
  copy.description = band.GetDescription();
  if (const OGRSpatialReference* const system = dataset.GetSpatialRef())
    copy.crs = crsTexts(*system);
  const Place place = placeOf(dataset);
  std::copy_n(place.geotransform, 6, heights.geotransform);
  heights.has_geotransform = place.has_geotransform;
  heights.registration = place.registration;
  groundSpacing(dataset.GetSpatialRef(), heights);
  heights.unit = copy.unit.c_str();
  heights.description = copy.description.c_str();
  heights.crs = copy.crs.crs.c_str();
  heights.vertical_datum = copy.crs.vertical_datum.c_str();
}

}  // namespace

Place placeOf(GDALDataset& dataset) {
  Place place{};
  place.has_geotransform = dataset.GetGeoTransform(place.geotransform) == CE_None;
  if (const char* const text = dataset.GetMetadataItem(GDALMD_AREA_OR_POINT)) {
    if (EQUAL(text, GDALMD_AOP_AREA)) place.registration = TKS_REGISTRATION_AREA;
    if (EQUAL(text, GDALMD_AOP_POINT)) place.registration = TKS_REGISTRATION_POINT;
  }
  return place;
}

std::unique_ptr<CopiedHeights> copyHeights(const std::string& name, GDALDataset& dataset,
                                           bool strict, const ProgressPart& progress) {
  if (dataset.GetRasterCount() != 1) {
    const std::string why = whyNoTexture(dataset);
    reportFailure(TKS_USAGE, name,
                  "Heights have one band, and the source has " +
                      std::to_string(dataset.GetRasterCount()) +
                      "; choose one (gdal_translate -b 1), and give an image as TEXTURE=." +
                      (why.empty() ? why : " " + why));
    return nullptr;
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const std::optional<tks_sample> sample = sampleOf(band);
  if (!sample) {
    reportFailure(TKS_UNSUPPORTED, name,
                  std::string("Samples of type ") + GDALGetDataTypeName(band.GetRasterDataType()) +
                      " are not supported; convert them to Int32 or Float32 (gdal_translate -ot).");
    return nullptr;
  }
  auto copy = std::make_unique<CopiedHeights>();
  tks_heights& heights = copy->heights;
  heights.size = sizeof heights;
  heights.width = static_cast<uint32_t>(band.GetXSize());
  heights.height = static_cast<uint32_t>(band.GetYSize());
  heights.sample = *sample;
  if (!readSamples(name, band, strict, *copy, progress)) return nullptr;
  takeNodata(band, *copy);
  if (!applyMask(name, band, *copy)) return nullptr;
  takeFacts(name, dataset, *copy);
  heights.data = copy->samples.data();
  if (!strict) takeFill(name, *copy);
  return copy;
}

}  // namespace tetrakis::gdal
