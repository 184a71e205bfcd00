// SPDX-License-Identifier: Apache-2.0
// The keys of a GeoTIFF (OGC GeoTIFF 1.1, 19-008r4, section 7.1).
#include "tools/files/geo_keys.hpp"

#include <algorithm>

namespace tetrakis::tools {

std::string tagText(TIFF* tiff, uint32_t tag) {
  const std::vector<char> text = tagValues<char>(tiff, tag, TIFF_ASCII);
  return {text.begin(), std::find(text.begin(), text.end(), '\0')};
}

std::string GeoKeys::epsg(GeoKey key) const {
  return code(key) == 0 || code(key) == kUserDefined ? "" : "EPSG:" + std::to_string(code(key));
}

std::string GeoKeys::firstText(std::initializer_list<GeoKey> order) const {
  for (const GeoKey key : order) {
    if (const std::string found = text(key); !found.empty()) return found;
  }
  return "";
}

/// Key directory: four 16-bit words of header, the last one the number of keys; then for each key
/// its id, the tag that holds its value (0: the fourth word is the value), count, and index there.
GeoKeys readGeoKeys(TIFF* tiff) {
  GeoKeys keys;
  const auto words = tagValues<uint16_t>(tiff, kGeoKeyDirectoryTag, TIFF_SHORT);
  const auto doubles = tagValues<double>(tiff, kGeoDoubleParamsTag, TIFF_DOUBLE);
  const std::string ascii = tagText(tiff, kGeoAsciiParamsTag);
  if (words.size() < 4) return keys;
  const size_t count = std::min<size_t>(words[3], words.size() / 4 - 1);
  for (size_t i = 1; i <= count; ++i) {
    const uint16_t id = words[4 * i], place = words[4 * i + 1];
    const uint16_t length = words[4 * i + 2], value = words[4 * i + 3];
    if (place == 0) {
      keys.codes[id] = value;
    } else if (place == kGeoDoubleParamsTag && value < doubles.size()) {
      keys.numbers[id] = doubles[value];
    } else if (place == kGeoAsciiParamsTag && value < ascii.size()) {
      std::string text = ascii.substr(value, length);
      if (text.ends_with('|')) text.pop_back();
      keys.texts[id] = text;
    }
  }
  return keys;
}

}  // namespace tetrakis::tools
