// SPDX-License-Identifier: Apache-2.0
// Heights and images as deflated TIFF with GeoTIFF and GDAL tags.
// Sources: OGC GeoTIFF 1.1 (19-008r4), section 7.1; GDAL GTiff driver.
#include <algorithm>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <vector>

#include "apps/tools/files/place/crs_keys.hpp"
#include "apps/tools/files/place/geo_tags.hpp"
#include "apps/tools/files/place/geo_units.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

/// The lower left corner is the origin, so that both coordinates stay positive.
GeoTransform localGrid(const HeightFile& heights) {
  return {0, heights.spacing_x, 0, heights.height * heights.spacing_y, 0, -heights.spacing_y};
}

bool setPlace(TIFF* tiff, const Georeference& place, const GeoKeys& keys) {
  if (!place.geotransform && keys.empty()) return true;
  const bool point = keys.code(kGtRasterTypeGeoKey) == TKS_REGISTRATION_POINT;
  if (place.geotransform && !writeTransform(tiff, *place.geotransform, point)) return false;
  return writeGeoKeys(tiff, keys);
}

/// GDAL escapes a description once more than XML does.
std::string escaped(const std::string& text) {
  pugi::xml_document document;
  document.append_child(pugi::node_pcdata).set_value(text.c_str());
  std::ostringstream xml;
  document.save(xml, "", pugi::format_raw | pugi::format_no_declaration);
  return xml.str();
}

/// A unit that the keys state needs no item, but for that of three axes, which GDAL does not look
/// for.
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
  const bool stated = statesHeights(keys) && heightUnit(keys) == heights.unit &&
                      !addsHeightsTo(keys.epsg(kGeodeticCrsGeoKey), keys.epsg(kVerticalGeoKey));
  if (!heights.unit.empty() && !stated) add("UNITTYPE", "unittype", heights.unit);
  if (!heights.description.empty()) add("DESCRIPTION", "description", escaped(heights.description));
  std::ostringstream xml;
  document.save(xml, "  ", pugi::format_indent | pugi::format_no_declaration);
  if (!root.first_child().empty() && !setTag(tiff, kGdalMetadataTag, xml.str())) return false;
  return !heights.nodata || setTag(tiff, kGdalNodataTag, shortest(*heights.nodata));
}

/// Samples as they lie in a file: row by row, interleaved.
struct Pixels {
  uint32_t width, height, channels;
  tks_sample sample;
  std::span<const std::byte> data;

  size_t rowBytes() const { return size_t{width} * channels * tks_sample_bytes(sample); }
  uint32_t rowsPerStrip() const {
    constexpr size_t kStripBytes = 1 << 18;
    return static_cast<uint32_t>(std::clamp<size_t>(kStripBytes / rowBytes(), 1, height));
  }
};

bool setLayout(TIFF* tiff, const Pixels& pixels) {
  const tks_sample sample = pixels.sample;
  const bool is_float = sample == TKS_F32;
  const bool is_signed = sample == TKS_I8 || sample == TKS_I16 || sample == TKS_I32;
  const int format =
      is_float ? SAMPLEFORMAT_IEEEFP : (is_signed ? SAMPLEFORMAT_INT : SAMPLEFORMAT_UINT);
  const int bits = static_cast<int>(8 * tks_sample_bytes(sample));
  const int photometric = pixels.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB;
  return TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, pixels.width) &&
         TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, pixels.height) &&
         TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits) &&
         TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format) &&
         TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, pixels.channels) &&
         TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
         TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric) &&
         TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, pixels.rowsPerStrip()) &&
         TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
         TIFFSetField(tiff, TIFFTAG_ZIPQUALITY, 3) &&
         TIFFSetField(tiff, TIFFTAG_PREDICTOR,
                      is_float ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
}

/// What the last of two or four channels is.
bool setExtraSample(TIFF* tiff, const ImageFile& image) {
  if (image.channels % 2 != 0) return true;
  const uint16_t kind = image.hasAlpha() ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_UNSPECIFIED;
  return TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind) == 1;
}

bool writeStrips(TIFF* tiff, const Pixels& pixels) {
  const size_t row_bytes = pixels.rowBytes();
  const uint32_t rows_per_strip = pixels.rowsPerStrip();
  for (uint32_t y = 0, strip = 0; y < pixels.height; y += rows_per_strip, ++strip) {
    const size_t bytes = row_bytes * std::min(rows_per_strip, pixels.height - y);
    // libtiff's parameter lacks a const: whole strips are copied before the predictor.
    void* rows = const_cast<std::byte*>(pixels.data.data() + y * row_bytes);
    if (TIFFWriteEncodedStrip(tiff, strip, rows, static_cast<tmsize_t>(bytes)) < 0) return false;
  }
  return true;
}

/// describe(tiff): sets the other tags.
template <class Describe>
Status writeTiff(const std::string& path, const Pixels& pixels, const Describe& describe) {
  constexpr size_t kClassicTiffBytes = 0xF0000000;
  const auto file = TiffFile::open(path, pixels.data.size() < kClassicTiffBytes ? "w" : "w8");
  if (!file.ok()) return file.status();
  TIFF* const tiff = file->get();
  announceGeoTags(tiff);
  const bool written =
      setLayout(tiff, pixels) && describe(tiff) && writeStrips(tiff, pixels) && TIFFFlush(tiff);
  return written ? Status() : file->failure();
}

}  // namespace

Status writeGeoTiff(const std::string& path, const HeightFile& heights) {
  Georeference place = heights;
  if (!place.geotransform && heights.spacing_x > 0 && heights.spacing_y > 0)
    place.geotransform = localGrid(heights);
  const GeoKeys keys = keysOf(heights);
  return writeTiff(
      path, {heights.width, heights.height, 1, heights.sample, heights.data},
      [&](TIFF* tiff) { return setPlace(tiff, place, keys) && setGdalTags(tiff, heights, keys); });
}

Status writeGeoTiff(const std::string& path, const ImageFile& image) {
  return writeTiff(
      path, {image.width, image.height, image.channels, image.sample, image.data}, [&](TIFF* tiff) {
        return setExtraSample(tiff, image) && setPlace(tiff, image.place, keysOf(image.place));
      });
}

}  // namespace tetrakis::tools
