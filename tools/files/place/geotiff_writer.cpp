// SPDX-License-Identifier: Apache-2.0
// Heights as deflated TIFF with GeoTIFF and GDAL tags.
// Sources: OGC GeoTIFF 1.1 (19-008r4), section 7.1; GDAL GTiff driver.
#include <algorithm>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <vector>

#include "tools/files/place/crs_keys.hpp"
#include "tools/files/place/geo_tags.hpp"
#include "tools/files/place/geo_units.hpp"
#include "tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

/// The lower left corner is the origin, so that both coordinates stay positive.
GeoTransform localGrid(const HeightFile& heights) {
  return {0, heights.spacing_x, 0, heights.height * heights.spacing_y, 0, -heights.spacing_y};
}

bool setPlace(TIFF* tiff, const Georeference& place, const GeoKeys& keys) {
  const bool point = keys.code(kGtRasterTypeGeoKey) == TKS_REGISTRATION_POINT;
  if (place.geotransform && !writeTransform(tiff, *place.geotransform, point)) return false;
  return writeGeoKeys(tiff, keys);
}

/// A unit that the keys state needs no item.
bool setGdalTags(TIFF* tiff, const HeightFile& heights, const GeoKeys& keys) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("GDALMetadata");
  const auto add = [&root](const char* name, const char* role, const std::string& value) {
    pugi::xml_node item = root.append_child("Item");
    item.append_attribute("name") = name;
    item.append_attribute("sample") = 0;
    item.append_attribute("role") = role;
    item.text() = value.c_str();
  };
  if (heights.offset != 0) add("OFFSET", "offset", shortest(heights.offset));
  if (heights.scale != 1) add("SCALE", "scale", shortest(heights.scale));
  const bool stated = statesHeights(keys) && heightUnit(keys) == heights.unit;
  if (!heights.unit.empty() && !stated) add("UNITTYPE", "unittype", heights.unit);
  if (!heights.description.empty()) add("DESCRIPTION", "description", heights.description);
  std::ostringstream xml;
  document.save(xml, "  ", pugi::format_indent | pugi::format_no_declaration);
  if (!root.first_child().empty() && !setTag(tiff, kGdalMetadataTag, xml.str())) return false;
  return !heights.nodata || setTag(tiff, kGdalNodataTag, shortest(*heights.nodata));
}

bool setLayout(TIFF* tiff, const HeightFile& heights, uint32_t rows_per_strip) {
  const bool is_float = heights.sample == TKS_F32;
  const bool is_signed =
      heights.sample == TKS_I8 || heights.sample == TKS_I16 || heights.sample == TKS_I32;
  const int format =
      is_float ? SAMPLEFORMAT_IEEEFP : (is_signed ? SAMPLEFORMAT_INT : SAMPLEFORMAT_UINT);
  const int bits = static_cast<int>(8 * tks_sample_bytes(heights.sample));
  return TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, heights.width) &&
         TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, heights.height) &&
         TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits) &&
         TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format) &&
         TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1) &&
         TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
         TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) &&
         TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, rows_per_strip) &&
         TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
         TIFFSetField(tiff, TIFFTAG_ZIPQUALITY, 3) &&
         TIFFSetField(tiff, TIFFTAG_PREDICTOR,
                      is_float ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
}

bool writeStrips(TIFF* tiff, const HeightFile& heights, uint32_t rows_per_strip) {
  const size_t row_bytes = size_t{heights.width} * tks_sample_bytes(heights.sample);
  for (uint32_t y = 0, strip = 0; y < heights.height; y += rows_per_strip, ++strip) {
    const size_t bytes = row_bytes * std::min(rows_per_strip, heights.height - y);
    // libtiff's parameter lacks a const: whole strips are copied before the predictor.
    void* rows = const_cast<std::byte*>(heights.data.data() + y * row_bytes);
    if (TIFFWriteEncodedStrip(tiff, strip, rows, static_cast<tmsize_t>(bytes)) < 0) return false;
  }
  return true;
}

}  // namespace

Status writeGeoTiff(const std::string& path, const HeightFile& heights) {
  constexpr size_t kClassicTiffBytes = 0xF0000000, kStripBytes = 1 << 18;
  const auto file = TiffFile::open(path, heights.data.size() < kClassicTiffBytes ? "w" : "w8");
  if (!file.ok()) return file.status();
  const size_t row_bytes = size_t{heights.width} * tks_sample_bytes(heights.sample);
  const auto rows =
      static_cast<uint32_t>(std::clamp<size_t>(kStripBytes / row_bytes, 1, heights.height));
  TIFF* const tiff = file->get();
  announceGeoTags(tiff);
  Georeference place = heights;
  if (!place.geotransform && heights.spacing_x > 0 && heights.spacing_y > 0)
    place.geotransform = localGrid(heights);
  const GeoKeys keys = keysOf(heights);
  const bool written = setLayout(tiff, heights, rows) && setPlace(tiff, place, keys) &&
                       setGdalTags(tiff, heights, keys) && writeStrips(tiff, heights, rows) &&
                       TIFFFlush(tiff);
  return written ? Status() : file->failure();
}

Status addGeoreference(const std::string& path, const Georeference& place) {
  const GeoKeys keys = keysOf(place);
  if (!place.geotransform && keys.empty()) return {};
  const auto file = TiffFile::open(path, "r+");
  if (!file.ok()) return file.status();
  announceGeoTags(file->get());
  const bool written = setPlace(file->get(), place, keys) && TIFFRewriteDirectory(file->get()) == 1;
  return written ? Status() : file->failure();
}

}  // namespace tetrakis::tools
