// SPDX-License-Identifier: Apache-2.0
// What a height file's TIFF tags tell: grid spacing, nodata, unit, datum, CRS.
// Sources: OGC GeoTIFF 1.1 (19-008r4), sections 7.1 (keys), 7.3 (model); GDAL GTiff driver.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <vector>

#include "tools/earth.hpp"
#include "tools/tiff.hpp"

namespace tetrakis::tools {
namespace {

/// The values of a tag, empty unless it is there with this type.
template <class T>
std::vector<T> tagValues(TIFF* tiff, uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  // libtiff gives tags that it does not know a 32-bit count before the values.
  if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field) ||
      TIFFFieldReadCount(field) != TIFF_VARIABLE2) {
    return {};
  }
  uint32_t count = 0;
  const T* values = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &values) || !values) return {};
  return {values, values + count};
}

std::string tagText(TIFF* tiff, uint32_t tag) {
  const std::vector<char> text = tagValues<char>(tiff, tag, TIFF_ASCII);
  return {text.begin(), std::find(text.begin(), text.end(), '\0')};
}

struct GeoKeys {
  std::map<uint16_t, uint16_t> codes;
  std::map<uint16_t, std::string> texts;

  /// 0 (undefined) when missing.
  uint16_t code(GeoKey key) const { return codes.contains(key) ? codes.at(key) : uint16_t{0}; }
  std::string text(GeoKey key) const { return texts.contains(key) ? texts.at(key) : ""; }
};

/// Key directory: four 16-bit words of header, the last one the number of keys; then for each key
/// its id, the tag that holds its value (0: the fourth word is the value), count, and index there.
GeoKeys readGeoKeys(TIFF* tiff) {
  GeoKeys keys;
  const auto words = tagValues<uint16_t>(tiff, kGeoKeyDirectoryTag, TIFF_SHORT);
  const std::string ascii = tagText(tiff, kGeoAsciiParamsTag);
  if (words.size() < 4) return keys;
  const size_t count = std::min<size_t>(words[3], words.size() / 4 - 1);
  for (size_t i = 1; i <= count; ++i) {
    const uint16_t id = words[4 * i], place = words[4 * i + 1];
    const uint16_t length = words[4 * i + 2], value = words[4 * i + 3];
    if (place == 0) {
      keys.codes[id] = value;
    } else if (place == kGeoAsciiParamsTag && value < ascii.size()) {
      std::string text = ascii.substr(value, length);
      if (text.ends_with('|')) text.pop_back();
      keys.texts[id] = text;
    }
  }
  return keys;
}

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
  const uint16_t unit = keys.code(kProjLinearUnitsGeoKey);
  if (unit == 0) return {1, 1};  // GeoTIFF's default is the metre
  for (const LengthUnit& known : kLengthUnits) {
    if (known.code == unit) return {known.metres, known.metres};
  }
  return {};
}

void setSpacing(HeightFile& heights, const GeoKeys& keys, const Grid& grid) {
  const MetresPerDegree metres = metresPerUnit(keys, grid);
  const double x = grid.step_x * metres.east, y = grid.step_y * metres.north;
  if (!std::isfinite(x) || !std::isfinite(y) || x <= 0 || y <= 0) return;
  heights.spacing_x = x;
  heights.spacing_y = y;
}

std::string firstText(const GeoKeys& keys, std::initializer_list<GeoKey> order) {
  for (const GeoKey key : order) {
    if (const std::string text = keys.text(key); !text.empty()) return text;
  }
  return "";
}

std::string epsg(uint16_t code) {
  return code == 0 || code == kUserDefined ? "" : "EPSG:" + std::to_string(code);
}

void setReferences(HeightFile& heights, const GeoKeys& keys) {
  const bool projected = keys.code(kGtModelTypeGeoKey) == kModelTypeProjected;
  heights.crs = epsg(keys.code(projected ? kProjectedCrsGeoKey : kGeodeticCrsGeoKey));
  if (heights.crs.empty()) {
    heights.crs = projected ? firstText(keys, {kProjectedCitationGeoKey, kGtCitationGeoKey})
                            : firstText(keys, {kGeodeticCitationGeoKey, kGtCitationGeoKey});
  }
  heights.vertical_datum = epsg(keys.code(kVerticalGeoKey));
  if (heights.vertical_datum.empty()) heights.vertical_datum = keys.text(kVerticalCitationGeoKey);
  for (const LengthUnit& known : kLengthUnits) {
    if (known.code == keys.code(kVerticalUnitsGeoKey)) heights.unit = known.name;
  }
}

template <class T>
std::optional<double> number(std::string_view text) {
  const size_t start = text.find_first_not_of(" +");
  if (start == std::string_view::npos) return {};
  T value{};
  const auto end = std::from_chars(text.data() + start, text.data() + text.size(), value);
  return end.ec == std::errc() ? std::optional<double>(value) : std::nullopt;
}

std::string unitName(const std::string& text) {
  for (const char* metre : {"metre", "meter", "metres", "meters", "Meter", "Metre"}) {
    if (text == metre) return "m";
  }
  return text;
}

/// <GDALMetadata><Item sample="0" role="scale|offset|unittype">value</Item></GDALMetadata>
void setGdalMetadata(HeightFile& heights, const std::string& xml) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return;
  for (const pugi::xml_node item : document.child("GDALMetadata").children("Item")) {
    if (item.attribute("sample").as_int() != 0) continue;
    const std::string_view role = item.attribute("role").value();
    const std::string text = item.text().get();
    const double value = number<double>(text).value_or(std::numeric_limits<double>::quiet_NaN());
    if (role == "scale" && std::isfinite(value) && value != 0) heights.scale = value;
    if (role == "offset" && std::isfinite(value)) heights.offset = value;
    if (role == "unittype") heights.unit = unitName(text);
  }
}

}  // namespace

Status readGeoTags(const std::string& path, HeightFile& heights) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  const GeoKeys keys = readGeoKeys(file->get());
  setSpacing(heights, keys, readGrid(file->get(), heights));
  setReferences(heights, keys);
  setGdalMetadata(heights, tagText(file->get(), kGdalMetadataTag));
  // As a float where samples are floats: the text must meet the sample's bits.
  const std::string nodata = tagText(file->get(), kGdalNodataTag);
  heights.nodata = heights.sample == TKS_F32 ? number<float>(nodata) : number<double>(nodata);
  return {};
}

}  // namespace tetrakis::tools
