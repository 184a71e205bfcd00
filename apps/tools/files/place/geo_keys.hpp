// SPDX-License-Identifier: Apache-2.0
// GeoKeys holds the keys of a GeoTIFF (OGC GeoTIFF 1.1, 19-008r4, section 7.1).
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {

struct GeoKeys {
  std::map<uint16_t, uint16_t> codes;
  std::map<uint16_t, std::vector<double>> numbers;
  std::map<uint16_t, std::string> texts;
  /// Of GeoTIFF 1: 0 where the keys of a GeoTIFF 1.0 state a vertical CRS, which GDAL then leaves
  /// out of the CRS. All other keys mean the same in both.
  uint16_t minor_revision = 1;

  /// 0 (undefined) when missing.
  uint16_t code(GeoKey key) const { return codes.contains(key) ? codes.at(key) : uint16_t{0}; }
  double number(GeoKey key) const { return numbers.contains(key) ? numbers.at(key).at(0) : 0; }
  std::string text(GeoKey key) const { return texts.contains(key) ? texts.at(key) : ""; }

  /// "EPSG:code"; "" when the key is missing or says that the user defines it.
  std::string epsg(GeoKey key) const;
  /// The first text that is not empty, or "".
  std::string firstText(std::initializer_list<GeoKey> order) const;
  bool empty() const { return codes.empty() && numbers.empty() && texts.empty(); }
  void remove(GeoKey key);
  /// Whether all of the other's keys are here with the same values and meaning.
  bool contain(const GeoKeys& other) const;
};

/// What makes no sense counts as missing.
GeoKeys readGeoKeys(TIFF* tiff);

/// False if libtiff refuses them, or they are too many for the tags. No keys, no tags.
bool writeGeoKeys(TIFF* tiff, const GeoKeys& keys);

/// Keys in rising order, each `number=value`, blanks between them (docs/FORMAT.md, section 2): a
/// code as an integer, numbers with a point or an exponent and commas between them, text in double
/// quotes, of which those inside are doubled. "1.0" goes before keys of that revision.
std::string textOf(const GeoKeys& keys);

/// The reverse; nothing if the text is not of that form.
std::optional<GeoKeys> parseGeoKeys(std::string_view text);

}  // namespace tetrakis::tools
