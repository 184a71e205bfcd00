// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/geo_tags.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/geo_keys.hpp"

namespace tetrakis::tools {
namespace {

// libtiff keeps the pointers: these fields must live as long as any file.
constexpr TIFFFieldInfo field(uint32_t tag, TIFFDataType type, const char* name) {
  return {tag, TIFF_VARIABLE2, TIFF_VARIABLE2, type, FIELD_CUSTOM, 1, 1, const_cast<char*>(name)};
}
const std::array<TIFFFieldInfo, 8> kGeoFields{
    {field(kModelPixelScaleTag, TIFF_DOUBLE, "ModelPixelScale"),
     field(kModelTiepointTag, TIFF_DOUBLE, "ModelTiepoint"),
     field(kModelTransformationTag, TIFF_DOUBLE, "ModelTransformation"),
     field(kGeoKeyDirectoryTag, TIFF_SHORT, "GeoKeyDirectory"),
     field(kGeoDoubleParamsTag, TIFF_DOUBLE, "GeoDoubleParams"),
     field(kGeoAsciiParamsTag, TIFF_ASCII, "GeoAsciiParams"),
     field(kGdalMetadataTag, TIFF_ASCII, "GDAL_METADATA"),
     field(kGdalNodataTag, TIFF_ASCII, "GDAL_NODATA")}};

/// `middle` so that middle - half is the corner again, where rounding allows.
double middleOf(double corner, double half) {
  const double middle = corner + half;
  for (const double side : {-HUGE_VAL, HUGE_VAL}) {
    const double near = std::nextafter(middle, side);
    if (middle - half != corner && near - half == corner) return near;
  }
  return middle;
}

}  // namespace

bool setTag(TIFF* tiff, uint32_t tag, const std::string& text) {
  return setTag(tiff, tag, std::span<const char>(text.c_str(), text.size() + 1));
}

void announceGeoTags(TIFF* tiff) {
  TIFFMergeFieldInfo(tiff, kGeoFields.data(), kGeoFields.size());
}

std::optional<GeoTransform> readTransform(TIFF* tiff, bool point, Notes& notes) {
  const auto scale = tagValues<double>(tiff, kModelPixelScaleTag, TIFF_DOUBLE);
  const auto tie = tagValues<double>(tiff, kModelTiepointTag, TIFF_DOUBLE);
  const auto m = tagValues<double>(tiff, kModelTransformationTag, TIFF_DOUBLE);
  const auto unusable = [&notes] {
    notes.push_back(
        {"its geotransform is not used: a scale is 0, or a number is NaN or too large", ""});
  };
  GeoTransform t{};
  if (scale.size() >= 2 && scale[0] != 0 && scale[1] != 0) {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    t = {kNowhere, scale[0], 0, kNowhere, 0, -std::abs(scale[1])};
    if (tie.size() >= 6) {
      t[0] = tie[3] - tie[0] * t[1];
      t[3] = tie[4] - tie[1] * t[5];
    }
  } else if (m.size() >= 8) {  // row-major: x = m0 i + m1 j + m3, y = m4 i + m5 j + m7
    t = {m[3], m[0], m[1], m[7], m[4], m[5]};
  } else {
    if (scale.size() >= 2) unusable();
    if (scale.empty() && tie.size() > 6)
      notes.push_back({"its ground control points are not kept: gdalwarp applies them", ""});
    return std::nullopt;
  }
  GeoTransform stated = t;
  if (m.size() < 8 && tie.size() < 6) stated[0] = stated[3] = 0;
  if (!isSound(stated)) unusable();
  if (point) {
    t[0] -= t[1] * 0.5 + t[2] * 0.5;
    t[3] -= t[4] * 0.5 + t[5] * 0.5;
  }
  return t;
}

bool writeTransform(TIFF* tiff, const GeoTransform& t, bool point) {
  const double x = point ? middleOf(t[0], t[1] * 0.5 + t[2] * 0.5) : t[0];
  const double y = point ? middleOf(t[3], t[4] * 0.5 + t[5] * 0.5) : t[3];
  if (t[2] == 0 && t[4] == 0 && t[1] != 0 && t[5] < 0) {
    const std::array<double, 3> scale{t[1], -t[5], 0};
    const std::array<double, 6> tie{0, 0, 0, x, y, 0};
    return setTag<double>(tiff, kModelPixelScaleTag, scale) &&
           setTag<double>(tiff, kModelTiepointTag, tie);
  }
  const std::array<double, 16> matrix{t[1], t[2], 0, x, t[4], t[5], 0, y, 0, 0, 0, 0, 0, 0, 0, 1};
  return setTag<double>(tiff, kModelTransformationTag, matrix);
}

}  // namespace tetrakis::tools
