// SPDX-License-Identifier: Apache-2.0
// What a height file's TIFF tags tell: grid spacing, nodata, unit, datum, CRS.
// Sources: OGC GeoTIFF 1.1 (19-008r4), sections 7.1 (keys), 7.3 (model); GDAL GTiff driver.
#include <charconv>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <vector>

#include "tools/files/earth.hpp"
#include "tools/files/geo_keys.hpp"
#include "tools/files/geo_units.hpp"
#include "tools/files/tiff.hpp"
#include "tools/files/units.hpp"

namespace tetrakis::tools {
namespace {

/// Size of one sample in the CRS's own units, and the vertical coordinate of the raster's centre.
struct Grid {
  double step_x = 0, step_y = 0;
  double centre_y = std::numeric_limits<double>::quiet_NaN();
};

Grid readGrid(TIFF* tiff, const HeightFile& heights) {
  Grid grid;
  const double column = heights.width / 2.0, row = heights.height / 2.0;
  const auto scale = tagValues<double>(tiff, kModelPixelScaleTag, TIFF_DOUBLE);
  const auto tie = tagValues<double>(tiff, kModelTiepointTag, TIFF_DOUBLE);
  const auto matrix = tagValues<double>(tiff, kModelTransformationTag, TIFF_DOUBLE);
  if (scale.size() >= 2) {
    grid.step_x = std::abs(scale[0]);
    grid.step_y = std::abs(scale[1]);
    if (tie.size() >= 6) grid.centre_y = tie[4] - (row - tie[1]) * scale[1];
  } else if (matrix.size() >= 8) {  // row-major: x = m0 i + m1 j + m3, y = m4 i + m5 j + m7
    grid.step_x = std::hypot(matrix[0], matrix[4]);
    grid.step_y = std::hypot(matrix[1], matrix[5]);
    grid.centre_y = matrix[4] * column + matrix[5] * row + matrix[7];
  }
  return grid;
}

/// Metres per unit of the CRS along x and y; 0 when unknown.
MetresPerDegree metresPerUnit(const GeoKeys& keys, const Grid& grid) {
  const uint16_t model = keys.code(kGtModelTypeGeoKey);
  if (model == kModelTypeGeographic) {
    constexpr uint16_t kDegree = 9102;
    const uint16_t unit = keys.code(kGeogAngularUnitsGeoKey);
    return unit == 0 || unit == kDegree ? metresPerDegree(grid.centre_y) : MetresPerDegree{};
  }
  if (model != kModelTypeProjected) return {};
  const double metres = gridUnit(keys).value_or(0);
  return {metres, metres};
}

void setSpacing(HeightFile& heights, const GeoKeys& keys, const Grid& grid, Notes& notes) {
  const MetresPerDegree metres = metresPerUnit(keys, grid);
  const bool projected = keys.code(kGtModelTypeGeoKey) == kModelTypeProjected;
  if (projected && grid.step_x > 0 && metres.east == 0) {
    notes.push_back(
        {"the unit of the grid is not stated, so its spacing is unknown: give --spacing",
         "--spacing"});
  }
  const double x = grid.step_x * metres.east, y = grid.step_y * metres.north;
  if (!std::isfinite(x) || !std::isfinite(y) || x <= 0 || y <= 0) return;
  heights.spacing_x = x;
  heights.spacing_y = y;
}

void setReferences(HeightFile& heights, const GeoKeys& keys) {
  const bool projected = keys.code(kGtModelTypeGeoKey) == kModelTypeProjected;
  heights.crs = keys.epsg(projected ? kProjectedCrsGeoKey : kGeodeticCrsGeoKey);
  if (heights.crs.empty()) {
    heights.crs = keys.firstText(
        {projected ? kProjectedCitationGeoKey : kGeodeticCitationGeoKey, kGtCitationGeoKey});
  }
  heights.vertical_datum = keys.epsg(kVerticalGeoKey);
  if (heights.vertical_datum.empty()) heights.vertical_datum = keys.text(kVerticalCitationGeoKey);
}

/// What GDAL's metadata say of the unit goes before the keys.
void setUnit(HeightFile& heights, const GeoKeys& keys, Notes& notes) {
  if (!heights.unit.empty() || !statesHeights(keys)) return;
  if (const std::optional<std::string> unit = heightUnit(keys)) {
    heights.unit = *unit;
    return;
  }
  const std::string& datum = heights.vertical_datum;
  notes.push_back({"the unit of the heights" + (datum.empty() ? "" : " over " + datum) +
                       " is not known and counts as metres: give --unit",
                   "--unit"});
}

std::optional<double> number(std::string_view text) {
  const size_t start = text.find_first_not_of(" +");
  if (start == std::string_view::npos) return {};
  double value = 0;
  const auto end = std::from_chars(text.data() + start, text.data() + text.size(), value);
  return end.ec == std::errc() ? std::optional(value) : std::nullopt;
}

/// <GDALMetadata><Item sample="0" role="scale|offset|unittype">value</Item></GDALMetadata>
void setGdalMetadata(HeightFile& heights, const std::string& xml) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return;
  for (const pugi::xml_node item : document.child("GDALMetadata").children("Item")) {
    if (item.attribute("sample").as_int() != 0) continue;
    const std::string_view role = item.attribute("role").value();
    const std::string text = item.text().get();
    const double value = number(text).value_or(std::numeric_limits<double>::quiet_NaN());
    if (role == "scale" && std::isfinite(value) && value != 0) heights.scale = value;
    if (role == "offset" && std::isfinite(value)) heights.offset = value;
    if (role == "unittype") heights.unit = canonicalUnit(text);
  }
}

}  // namespace

Status readGeoTags(const std::string& path, HeightFile& heights, Notes& notes) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  const GeoKeys keys = readGeoKeys(file->get());
  setSpacing(heights, keys, readGrid(file->get(), heights), notes);
  setReferences(heights, keys);
  setGdalMetadata(heights, tagText(file->get(), kGdalMetadataTag));
  setUnit(heights, keys, notes);
  heights.nodata = number(tagText(file->get(), kGdalNodataTag));
  return {};
}

}  // namespace tetrakis::tools
