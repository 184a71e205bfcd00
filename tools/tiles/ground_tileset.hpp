// SPDX-License-Identifier: Apache-2.0
// The ground as 3D Tiles 1.1 (OGC 22-025r4): a tree of GLB meshes in the axes of the Earth.
//
// Positions are whole multiples of a power of two, one for all tiles of a level, and so are the
// origins of the tiles: floats hold them exactly, and neighbours have the same points on the edge
// that they share, to the bit.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/status.hpp"
#include "tools/tiles/terrain_level.hpp"

namespace tetrakis::tools {

class GroundTileset {
 public:
  /// Tiles come level by level, from the deepest up. Returns the tile's GLB; no bytes: it has no
  /// ground, and none of the tiles below is lost by that. error: metres.
  Result<std::vector<std::byte>> add(const TileMesh& mesh, const GeographicTile& tile,
                                     double error);

  /// tileset.json, after all tiles.
  nlohmann::json document(const GeographicBounds& bounds) const;

 private:
  struct Node {
    nlohmann::json tile;
    GeographicBounds bounds;
    double lowest, highest;
  };
  using Level = std::map<std::pair<uint32_t, uint32_t>, Node>;

  uint32_t level_ = 0;
  double error_ = 0;     ///< of the level
  Level nodes_, below_;  ///< of the level, and those that no tile of it has taken yet
};

}  // namespace tetrakis::tools
