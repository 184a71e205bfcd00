// SPDX-License-Identifier: Apache-2.0
// The keys of a GeoTIFF (OGC GeoTIFF 1.1, 19-008r4, section 7.1).
#include "apps/tools/files/place/geo_keys.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "apps/tools/files/place/geo_tags.hpp"
#include "apps/tools/files/place/geo_units.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {

std::string GeoKeys::epsg(GeoKey key) const {
  return code(key) == 0 || code(key) == kUserDefined ? "" : "EPSG:" + std::to_string(code(key));
}

std::string GeoKeys::firstText(std::initializer_list<GeoKey> order) const {
  for (const GeoKey key : order) {
    if (const std::string found = text(key); !found.empty()) return found;
  }
  return "";
}

void GeoKeys::remove(GeoKey key) {
  codes.erase(key);
  numbers.erase(key);
  texts.erase(key);
}

bool GeoKeys::contain(const GeoKeys& other) const {
  const auto holds = [](const auto& all, const auto& some) {
    return std::all_of(some.begin(), some.end(), [&all](const auto& item) {
      const auto found = all.find(item.first);
      return found != all.end() && found->second == item.second;
    });
  };
  return minor_revision == other.minor_revision && holds(codes, other.codes) &&
         holds(numbers, other.numbers) && holds(texts, other.texts);
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
    } else if (place == kGeoDoubleParamsTag && length > 0 &&
               size_t{value} + length <= doubles.size()) {
      keys.numbers[id].assign(doubles.begin() + value, doubles.begin() + value + length);
    } else if (place == kGeoAsciiParamsTag && value < ascii.size()) {
      std::string text = ascii.substr(value, length);
      if (text.ends_with('|')) text.pop_back();
      keys.texts[id] = asUtf8(std::move(text));
    }
  }
  const bool vertical = statesHeights(keys) || keys.codes.contains(kVerticalDatumGeoKey) ||
                        keys.texts.contains(kVerticalCitationGeoKey);
  if (words[1] == 1 && words[2] == 0 && vertical) keys.minor_revision = 0;
  return keys;
}

bool writeGeoKeys(TIFF* tiff, const GeoKeys& keys) {
  if (keys.empty()) return true;
  std::map<uint16_t, std::array<size_t, 3>> entries;  // in rising order: place, length, value
  std::vector<double> doubles;
  std::string ascii;
  for (const auto& [id, code] : keys.codes) entries[id] = {0, 1, code};
  for (const auto& [id, numbers] : keys.numbers) {
    entries[id] = {kGeoDoubleParamsTag, numbers.size(), doubles.size()};
    doubles.insert(doubles.end(), numbers.begin(), numbers.end());
  }
  for (const auto& [id, text] : keys.texts) {
    entries[id] = {kGeoAsciiParamsTag, text.size() + 1, ascii.size()};
    ascii += text + '|';
  }
  if (std::max({entries.size(), doubles.size(), ascii.size()}) > UINT16_MAX) return false;
  std::vector<uint16_t> words{1, 1, keys.minor_revision, static_cast<uint16_t>(entries.size())};
  for (const auto& [id, entry] : entries) {
    words.push_back(id);
    for (const size_t word : entry) words.push_back(static_cast<uint16_t>(word));
  }
  return setTag<uint16_t>(tiff, kGeoKeyDirectoryTag, words) &&
         (doubles.empty() || setTag<double>(tiff, kGeoDoubleParamsTag, doubles)) &&
         (ascii.empty() || setTag(tiff, kGeoAsciiParamsTag, ascii));
}

}  // namespace tetrakis::tools
