// SPDX-License-Identifier: Apache-2.0
// GroundTileset writes the ground as 3D Tiles 1.1 (OGC 22-025r4): a tree of GLB meshes in the axes
// of the Earth.
//
// Positions are whole multiples of a power of two, one for all tiles of a level, and so are the
// origins of the tiles: floats hold them exactly, and neighbours have the same points on the edge
// that they share, to the bit.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/tiles/terrain_level.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// In metres.
struct TileErrors {
  double heights;  ///< of the mesh
  double shown;    ///< what viewers go by
};

/// The triangles whose corners are all ground.
TileMesh groundOf(const TileMesh& mesh);

/// Adds walls of this depth, seen from outside, below the edges on the sides of the tile: they fill
/// the gaps to neighbours that are shown at another level.
void addSkirts(TileMesh& ground, double depth);

class GroundTileset {
 public:
  /// bounds: of the ground, beyond which no tile has any.
  explicit GroundTileset(const GeographicBounds& bounds) : bounds_(bounds) {}

  /// Tiles come level by level, from the deepest up. Returns the tile's GLB; no bytes: it has no
  /// ground, and the tiles below it become those of the tile above. texture: its outer texels lie
  /// on the edges of the tile; null: none.
  Result<std::vector<std::byte>> add(const TileMesh& ground, const GeographicTile& tile,
                                     const TileErrors& errors, const ImageFile* texture);

  /// tileset.json, after all tiles.
  nlohmann::json document() const;

 private:
  /// The part of a tile where there may be ground.
  GeographicBounds groundIn(const GeographicTile& tile) const;

  struct Node {
    nlohmann::json tile;
    double lowest, highest;
  };
  using Level = std::map<std::pair<uint32_t, uint32_t>, Node>;

  /// A tile of which only those below it are known, which it takes.
  Node overThoseBelow(const GeographicTile& tile);

  GeographicBounds bounds_;
  uint32_t level_ = 0;
  double error_ = 0;     ///< that viewers go by on the level
  Level nodes_, below_;  ///< of the level, and those that no tile of it has taken yet
};

}  // namespace tetrakis::tools
