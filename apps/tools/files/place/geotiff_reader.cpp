// SPDX-License-Identifier: Apache-2.0
// What TIFF tags tell: place, CRS, grid spacing, and of heights nodata, unit and datum.
// Sources: OGC GeoTIFF 1.1 (19-008r4), sections 7.1 (keys), 7.3 (model); GDAL GTiff driver.
#include <charconv>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/pictures/tag_number.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/crs_keys.hpp"
#include "apps/tools/files/place/geo_tags.hpp"
#include "apps/tools/files/place/geo_units.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/text.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

bool speaksOfPoints(const GeoKeys& keys) {
  return keys.code(kGtRasterTypeGeoKey) == TKS_REGISTRATION_POINT;
}

void setSpacing(HeightFile& heights, const GeoKeys& keys,
                const std::optional<GeoTransform>& transform, Notes& notes) {
  if (!transform) return;
  const GridUnit unit = gridUnitOf(keys);
  const bool projected = keys.code(kGtModelTypeGeoKey) == kModelTypeProjected;
  if (projected && unit.metres == 0) {
    notes.push_back(
        {"the unit of the grid is not stated, so its spacing is unknown: give --spacing",
         "--spacing"});
  }
  const auto spacing = groundSpacing(*transform, heights.width, heights.height, unit, heights.crs);
  if (!spacing) return;
  heights.spacing_x = (*spacing)[0];
  heights.spacing_y = (*spacing)[1];
}

void setPlace(Georeference& place, const GeoKeys& keys,
              const std::optional<GeoTransform>& transform) {
  if (transform && isSound(*transform)) place.geotransform = transform;
  const uint16_t type = keys.code(kGtRasterTypeGeoKey);
  if (type == TKS_REGISTRATION_AREA || type == TKS_REGISTRATION_POINT)
    place.registration = static_cast<tks_registration>(type);
  const bool projected = keys.code(kGtModelTypeGeoKey) == kModelTypeProjected;
  place.crs = wktIn(keys);
  if (place.crs.empty())
    place.crs = keys.epsg(projected ? kProjectedCrsGeoKey : kGeodeticCrsGeoKey);
  if (place.crs.empty()) {
    place.crs = keys.firstText(
        {projected ? kProjectedCitationGeoKey : kGeodeticCitationGeoKey, kGtCitationGeoKey});
  }
}

/// Keys that writing would not make of the rest are kept.
template <class Raster>
void keepKeys(Raster& raster, GeoKeys keys) {
  keys.remove(kGtRasterTypeGeoKey);
  if (!keys.empty() && !keysOf(raster).contain(keys)) raster.geo_keys = textOf(keys);
}

void setVerticalDatum(HeightFile& heights, const GeoKeys& keys) {
  heights.vertical_datum = keys.epsg(kVerticalGeoKey);
  if (heights.vertical_datum.empty()) heights.vertical_datum = keys.text(kVerticalCitationGeoKey);
  if (keys.minor_revision > 0 && addsHeightsTo(heights.crs, heights.vertical_datum))
    heights.crs = std::exchange(heights.vertical_datum, "");
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

/// Nothing if the file declares none that is a number.
std::optional<double> nodataIn(const std::string& text, Notes& notes) {
  const std::optional<double> nodata = tagNumber(text);
  if (!nodata && !isBlank(text))
    notes.push_back({"its nodata value " + quoted(text) +
                         " is no number and is not used: give "
                         "--nodata",
                     "--nodata"});
  return nodata;
}

/// GDAL escapes a description once more than XML does.
std::string unescaped(const std::string& text) {
  pugi::xml_document document;
  const bool sound = document.load_string(("<text>" + text + "</text>").c_str());
  return sound ? document.child("text").text().get() : text;
}

/// <GDALMetadata><Item sample="0" role="ROLE">value</Item></GDALMetadata>
void setGdalMetadata(HeightFile& heights, const std::string& xml, Notes& notes) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return;
  for (const pugi::xml_node item : document.child("GDALMetadata").children("Item")) {
    if (item.attribute("sample").as_int() != 0) continue;
    const std::string_view role = item.attribute("role").value();
    const std::string text = asUtf8(item.text().get());
    const double value = tagNumber(text).value_or(std::numeric_limits<double>::quiet_NaN());
    if (role == "scale" && std::isfinite(value) && value != 0) heights.scale = value;
    if (role == "scale" && heights.scale != value)
      notes.push_back(
          {"its scale " + quoted(text) + " is none and is not used: give --scale", "--scale"});
    if (role == "offset" && std::isfinite(value)) heights.offset = value;
    if (role == "offset" && heights.offset != value)
      notes.push_back(
          {"its offset " + quoted(text) + " is none and is not used: give --offset", "--offset"});
    if (role == "unittype") heights.unit = canonicalUnit(text);
    if (role == "description") heights.description = unescaped(text);
  }
}

}  // namespace

Status readGeoTags(const std::string& path, HeightFile& heights, Notes& notes) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  TIFF* const tiff = file->get();
  const GeoKeys keys = readGeoKeys(tiff);
  const auto transform = readTransform(tiff, speaksOfPoints(keys), notes);
  setPlace(heights, keys, transform);
  setSpacing(heights, keys, transform, notes);
  setVerticalDatum(heights, keys);
  setGdalMetadata(heights, tagText(tiff, kGdalMetadataTag), notes);
  setUnit(heights, keys, notes);
  keepKeys(heights, keys);
  heights.nodata = nodataIn(tagText(tiff, kGdalNodataTag), notes);
  return {};
}

Result<Georeference> readGeoreference(const std::string& path, Notes& notes) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  const GeoKeys keys = readGeoKeys(file->get());
  Georeference place;
  setPlace(place, keys, readTransform(file->get(), speaksOfPoints(keys), notes));
  keepKeys(place, keys);
  return place;
}

}  // namespace tetrakis::tools
