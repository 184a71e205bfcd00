// SPDX-License-Identifier: Apache-2.0
// GeographicTile is a tile of the quadtree over longitude and latitude that Cesium's terrain has
// (TMS, global-geodetic): two tiles on level 0, rows counted from the south.
#pragma once

#include <cstdint>
#include <vector>

namespace tetrakis::tools {

/// In degrees.
struct GeographicBounds {
  double west = 0, south = 0, east = 0, north = 0;
};

struct GeographicTile {
  uint32_t level = 0, x = 0, y = 0;
};

/// Tiles of one level, both ends included.
struct TileRange {
  uint32_t level = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  uint64_t count() const { return (uint64_t{x1} - x0 + 1) * (uint64_t{y1} - y0 + 1); }
};

/// Degrees along a side of a tile.
double tileDegrees(uint32_t level);

GeographicBounds boundsOf(const GeographicTile& tile);

/// The tiles that these bounds reach; of level 0 always both, which viewers begin with.
TileRange tilesOver(const GeographicBounds& bounds, uint32_t level);

/// Those of a range that lie below a tile, or are it; false if none does.
bool below(const GeographicTile& tile, TileRange& range);

}  // namespace tetrakis::tools
