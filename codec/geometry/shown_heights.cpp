// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/shown_heights.hpp"

#include <utility>

namespace tetrakis::inline geometry {

DecodedHeights shownHeights(const ShownLines& lines, DecodedHeights decoded) {
  if (lines.none()) return decoded;
  DecodedGeometry& geometry = decoded.geometry;
  geometry.heights = lines.shown(std::move(geometry.heights));
  geometry.valid = lines.shown(std::move(geometry.valid));
  geometry.significant = lines.shown(std::move(geometry.significant));
  decoded.corrections = lines.shown(std::move(decoded.corrections));
  const ShownLines::Lines &columns = lines.columns(), &rows = lines.rows();
  geometry.width = static_cast<uint32_t>(columns.size());
  geometry.height = static_cast<uint32_t>(rows.size());
  geometry.quiet_levels = 0;
  if (geometry.significant.empty()) return decoded;
  for (size_t y = 0, i = 0; y < rows.size(); ++y) {
    const bool repeated_row = y > 0 && rows[y] == rows[y - 1];
    for (size_t x = 0; x < columns.size(); ++x, ++i) {
      if (repeated_row || (x > 0 && columns[x] == columns[x - 1])) geometry.significant[i] = 0;
    }
  }
  return decoded;
}

}  // namespace tetrakis::inline geometry
