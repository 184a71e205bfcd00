// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/geographic_tile.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::tools {

double tileDegrees(uint32_t level) {
  return std::ldexp(180, -static_cast<int>(level));
}

GeographicBounds boundsOf(const GeographicTile& tile) {
  const double side = tileDegrees(tile.level);
  return {tile.x * side - 180, tile.y * side - 90, (tile.x + 1.0) * side - 180,
          (tile.y + 1.0) * side - 90};
}

TileRange tilesOver(const GeographicBounds& bounds, uint32_t level) {
  if (level == 0) return {0, 0, 0, 1, 0};
  const double side = tileDegrees(level), last_y = std::ldexp(1, static_cast<int>(level)) - 1;
  const auto first = [side](double from, double last) {
    return static_cast<uint32_t>(std::clamp(std::floor(from / side), 0.0, last));
  };
  // A tile that only touches is none.
  const auto final = [side](double to, double last) {
    return static_cast<uint32_t>(std::clamp(std::ceil(to / side) - 1, 0.0, last));
  };
  const double last_x = 2 * last_y + 1;
  TileRange range{level, first(bounds.west + 180, last_x), first(bounds.south + 90, last_y),
                  final(bounds.east + 180, last_x), final(bounds.north + 90, last_y)};
  range.x1 = std::max(range.x0, range.x1);
  range.y1 = std::max(range.y0, range.y1);
  return range;
}

bool below(const GeographicTile& tile, TileRange& range) {
  if (range.level < tile.level) return false;
  const uint32_t down = range.level - tile.level;
  const auto last = [down](uint32_t place) { return ((place + 1) << down) - 1; };
  range.x0 = std::max(range.x0, tile.x << down);
  range.y0 = std::max(range.y0, tile.y << down);
  range.x1 = std::min(range.x1, last(tile.x));
  range.y1 = std::min(range.y1, last(tile.y));
  return range.x0 <= range.x1 && range.y0 <= range.y1;
}

}  // namespace tetrakis::tools
