// SPDX-License-Identifier: Apache-2.0
// Heights as deflated TIFF with GeoTIFF and GDAL tags.
// Sources: OGC GeoTIFF 1.1 (19-008r4), section 7.1; GDAL GTiff driver.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <vector>

#include "tools/files/text.hpp"
#include "tools/files/tiff.hpp"

namespace tetrakis::tools {
namespace {

// libtiff keeps the pointers: these fields must live as long as any file.
const std::array<TIFFFieldInfo, 6> kGeoFields{{
    {kModelPixelScaleTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("ModelPixelScale")},
    {kModelTiepointTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("ModelTiepoint")},
    {kGeoKeyDirectoryTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_SHORT, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("GeoKeyDirectory")},
    {kGeoAsciiParamsTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_ASCII, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("GeoAsciiParams")},
    {kGdalMetadataTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_ASCII, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("GDAL_METADATA")},
    {kGdalNodataTag, TIFF_VARIABLE2, TIFF_VARIABLE2, TIFF_ASCII, FIELD_CUSTOM, 1, 1,
     const_cast<char*>("GDAL_NODATA")},
}};

template <class T>
bool setTag(TIFF* tiff, uint32_t tag, std::span<const T> values) {
  return TIFFSetField(tiff, tag, static_cast<uint32_t>(values.size()), values.data()) == 1;
}

/// With its terminating zero, which TIFF counts.
bool setTag(TIFF* tiff, uint32_t tag, const std::string& text) {
  return setTag(tiff, tag, std::span<const char>(text.c_str(), text.size() + 1));
}

/// Keys in rising order (the directory must be sorted) with the text values behind them.
struct KeyDirectory {
  std::vector<uint16_t> words{1, 1, 1, 0};  // version, revision 1.1, number of keys
  std::string texts;

  void add(GeoKey key, uint16_t code) { append({key, 0, 1, code}); }
  void add(GeoKey key, const std::string& text) {
    append({key, kGeoAsciiParamsTag, static_cast<uint16_t>(text.size() + 1),
            static_cast<uint16_t>(texts.size())});
    texts += text + '|';
  }
  void append(std::initializer_list<uint16_t> key) {
    words.insert(words.end(), key);
    ++words[3];
  }
};

void addVerticalKeys(KeyDirectory& keys, const HeightFile& heights) {
  constexpr std::string_view kEpsg = "EPSG:";
  constexpr size_t kMaxCitation = 1024;
  const std::string& datum = heights.vertical_datum;
  uint16_t code = 0;
  if (datum.starts_with(kEpsg)) {
    std::from_chars(datum.data() + kEpsg.size(), datum.data() + datum.size(), code);
  }
  if (code != 0) {
    keys.add(kVerticalGeoKey, code);
  } else if (!datum.empty() && datum.size() <= kMaxCitation) {
    keys.add(kVerticalGeoKey, kUserDefined);
    keys.add(kVerticalCitationGeoKey, datum);
  }
  for (const LengthUnit& known : kLengthUnits) {
    if (heights.unit == known.name) keys.add(kVerticalUnitsGeoKey, known.code);
  }
}

bool setGeoKeys(TIFF* tiff, const HeightFile& heights) {
  KeyDirectory keys;
  if (heights.spacing_x > 0 && heights.spacing_y > 0) {
    const std::array<double, 3> scale{heights.spacing_x, heights.spacing_y, 0};
    // The lower left corner is the origin, so that both coordinates stay positive.
    const std::array<double, 6> tie{0, 0, 0, 0, heights.height * heights.spacing_y, 0};
    if (!setTag<double>(tiff, kModelPixelScaleTag, scale)) return false;
    if (!setTag<double>(tiff, kModelTiepointTag, tie)) return false;
    constexpr uint16_t kPixelIsArea = 1;
    keys.add(kGtModelTypeGeoKey, kModelTypeProjected);
    keys.add(kGtRasterTypeGeoKey, kPixelIsArea);
    keys.add(kProjectedCrsGeoKey, kUserDefined);
    keys.add(kProjLinearUnitsGeoKey, kLengthUnits[0].code);
  }
  addVerticalKeys(keys, heights);
  if (keys.words[3] == 0) return true;
  return setTag<uint16_t>(tiff, kGeoKeyDirectoryTag, keys.words) &&
         (keys.texts.empty() || setTag(tiff, kGeoAsciiParamsTag, keys.texts));
}

bool setGdalTags(TIFF* tiff, const HeightFile& heights) {
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
  if (!heights.unit.empty()) add("UNITTYPE", "unittype", heights.unit);
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
  TIFFMergeFieldInfo(file->get(), kGeoFields.data(), kGeoFields.size());
  const bool written = setLayout(file->get(), heights, rows) && setGeoKeys(file->get(), heights) &&
                       setGdalTags(file->get(), heights) &&
                       writeStrips(file->get(), heights, rows) && TIFFFlush(file->get());
  return written ? Status() : file->failure();
}

}  // namespace tetrakis::tools
