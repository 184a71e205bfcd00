// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/pam.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "apps/tools/files/place/given_crs.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/place/proj_objects.hpp"
#include "apps/tools/files/text.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

/// The number at the front of a text, which then begins behind it and the comma.
std::optional<double> takeNumber(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n+,"), text.size()));
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

std::optional<double> numberIn(const pugi::xml_node& node) {
  std::string_view text = node.text().get();
  return takeNumber(text);
}

std::optional<GeoTransform> transformIn(const pugi::xml_node& node) {
  std::string_view text = node.text().get();
  GeoTransform transform;
  for (double& number : transform) {
    const std::optional<double> next = takeNumber(text);
    if (!next) return std::nullopt;
    number = *next;
  }
  return isSound(transform) ? std::optional(transform) : std::nullopt;
}

/// "EPSG:code" for WKT that has one.
std::string shortCrs(const std::string& wkt) {
  const ProjContext context = quietContext();
  const ProjObject crs = context ? findCrs(context.get(), wkt) : nullptr;
  const char* authority = crs ? proj_get_id_auth_name(crs.get(), 0) : nullptr;
  const char* code = crs ? proj_get_id_code(crs.get(), 0) : nullptr;
  if (authority == nullptr || code == nullptr || std::string_view(authority) != "EPSG") return wkt;
  return std::string("EPSG:") + code;
}

/// The dataset in the file beside a picture; empty if there is none.
pugi::xml_document documentBeside(const std::string& picture) {
  pugi::xml_document document;
  if (picture != "-" && !document.load_file((picture + ".aux.xml").c_str())) document.reset();
  return document;
}

/// What ArcGIS keeps of a picture that it has placed.
pugi::xml_node arcGisIn(const pugi::xml_node& dataset) {
  return dataset.find_child_by_attribute("Metadata", "domain", "xml:ESRI").child("GeodataXform");
}

/// ArcGIS keeps the CRS with its transform.
std::string crsIn(const pugi::xml_node& dataset) {
  const std::string wkt = asUtf8(dataset.child("SRS").text().get());
  if (!wkt.empty()) return wkt;
  return asUtf8(arcGisIn(dataset).child("SpatialReference").child("WKT").text().get());
}

/// GDAL takes no polynomial of ArcGIS either.
void tellArcGis(const pugi::xml_node& dataset, const Georeference& place, Notes& notes) {
  const pugi::xml_node transform = arcGisIn(dataset);
  if (place.geotransform) return;
  if (transform.child("SourceGCPs")) {
    notes.push_back(
        {"of the .aux.xml of ArcGIS only the CRS is read, not its control points: "
         "gdal_translate applies them",
         ""});
  } else if (transform.child("CoeffX")) {
    notes.push_back(
        {"of the .aux.xml of ArcGIS only the CRS is read, not its polynomial: a world "
         "file beside, or gdal_edit.py -a_ullr, can say where it lies",
         ""});
  }
}

void takePlace(const pugi::xml_node& dataset, Georeference& place) {
  if (const auto transform = transformIn(dataset.child("GeoTransform")))
    place.geotransform = transform;
  for (const pugi::xml_node item : dataset.child("Metadata").children("MDI")) {
    if (std::string_view(item.attribute("key").value()) != "AREA_OR_POINT") continue;
    const bool point = std::string_view(item.text().get()) == "Point";
    place.registration = point ? TKS_REGISTRATION_POINT : TKS_REGISTRATION_AREA;
  }
}

void takeBand(const pugi::xml_node& band, HeightFile& heights) {
  if (const auto nodata = numberIn(band.child("NoDataValue"))) heights.nodata = nodata;
  const auto scale = numberIn(band.child("Scale")), offset = numberIn(band.child("Offset"));
  if (scale && std::isfinite(*scale) && *scale != 0) heights.scale = *scale;
  if (offset && std::isfinite(*offset)) heights.offset = *offset;
  const std::string unit = asUtf8(band.child("UnitType").text().get());
  if (!unit.empty()) heights.unit = canonicalUnit(unit);
  const std::string description = asUtf8(band.child("Description").text().get());
  if (!description.empty()) heights.description = description;
}

}  // namespace

void takePam(const std::string& picture, Georeference& place, Notes& notes) {
  const pugi::xml_document document = documentBeside(picture);
  const pugi::xml_node dataset = document.child("PAMDataset");
  takePlace(dataset, place);
  tellArcGis(dataset, place, notes);
  const std::string wkt = crsIn(dataset);
  if (wkt.empty()) return;
  place.crs = shortCrs(wkt);
  place.geo_keys.clear();
}

void takePam(const std::string& picture, HeightFile& heights, Notes& notes) {
  const pugi::xml_document document = documentBeside(picture);
  const pugi::xml_node dataset = document.child("PAMDataset");
  if (!dataset) return;
  takePlace(dataset, heights);
  tellArcGis(dataset, heights, notes);
  const std::string wkt = crsIn(dataset);
  if (!wkt.empty()) giveCrs(heights, shortCrs(wkt));
  if (dataset.child("GeoTransform")) setGroundSpacing(heights);
  for (const pugi::xml_node band : dataset.children("PAMRasterBand"))
    if (band.attribute("band").as_int() == 1) takeBand(band, heights);
}

void takePam(const std::string& picture, std::vector<BandColour>& colours) {
  const pugi::xml_document document = documentBeside(picture);
  for (const pugi::xml_node band : document.child("PAMDataset").children("PAMRasterBand")) {
    const size_t number = band.attribute("band").as_uint();
    const std::string name = band.child("ColorInterp").text().get();
    if (number >= 1 && number <= colours.size() && !name.empty())
      colours[number - 1] = bandColour(name);
  }
}

void takePam(const std::string& picture, std::vector<double>& nodata) {
  const pugi::xml_document document = documentBeside(picture);
  for (const pugi::xml_node band : document.child("PAMDataset").children("PAMRasterBand")) {
    const size_t number = band.attribute("band").as_uint();
    const std::optional<double> value = numberIn(band.child("NoDataValue"));
    if (value && number >= 1 && number <= nodata.size()) nodata[number - 1] = *value;
  }
}

}  // namespace tetrakis::tools
