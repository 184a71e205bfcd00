// SPDX-License-Identifier: Apache-2.0
// TerrainLevel is one level of terrain tiles: a grid of heights over all its tiles, and a 4-8 mesh
// of it. The whole level has one mesh, so the tiles cut from it share their edges exactly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/tools/tiles/earth_ground.hpp"
#include "apps/tools/tiles/geographic_tile.hpp"

namespace tetrakis::tools {

/// Cells along a side of a tile.
inline constexpr uint32_t kTileCells = 64;

/// A mesh over the cells of a tile, from its south-western corner.
struct TileMesh {
  struct Vertex {
    uint32_t column, row;  ///< 0 to kTileCells, eastwards and northwards
    float height;          ///< metres
    float east, north;     ///< slopes
    bool ground;           ///< the stream covers it; else the height is 0
  };
  std::vector<Vertex> vertices;     ///< in the order in which triangles first have them
  std::vector<uint32_t> triangles;  ///< counter-clockwise seen from above
};

class TerrainLevel {
 public:
  /// Samples the ground; what it does not cover has the height 0.
  TerrainLevel(const EarthGround& ground, const LevelSurface& surface, double metres_per_unit,
               const TileRange& range);

  /// Keeps the vertices that are more than `error` metres off without them, where the Earth is
  /// round among other reasons, and those that the mesh
  /// then needs to be conforming.
  /// outline: and those along the edge of the ground, whose slopes then know nothing of what lies
  /// beyond.
  void chooseVertices(double error, bool outline);

  /// Of a tile of the range.
  TileMesh meshOf(const GeographicTile& tile) const;

  const TileRange& range() const { return range_; }
  float lowest() const { return lowest_; }
  float highest() const { return highest_; }

 private:
  /// Of the grid, from the south-western corner of the range.
  struct Place {
    int64_t x, y;
  };
  size_t at(const Place& place) const {
    return static_cast<size_t>(place.y) * columns_ + static_cast<size_t>(place.x);
  }
  bool inside(const Place& place) const {
    return place.x >= 0 && place.y >= 0 && place.x < columns_ && place.y < rows_;
  }
  /// The range goes round the Earth: its first and last columns lie at one longitude.
  bool goesRound() const {
    return range_.x0 == 0 && uint64_t{range_.x1} + 1 == uint64_t{2} << range_.level;
  }
  /// The lattice repeats itself over pairs of tiles, so it is the same in all ranges.
  int64_t phaseX() const { return int64_t{range_.x0 % 2} * kTileCells; }
  int64_t phaseY() const { return int64_t{range_.y0 % 2} * kTileCells; }

  float sagitta(int64_t half, bool centre) const;
  void joinEnds(int64_t half);
  void lift(Place vertex, int64_t half, bool centre);
  void split(TileMesh& mesh, std::vector<uint32_t>& numbers, const Place& origin,
             const std::array<Place, 3>& corners) const;
  uint32_t number(TileMesh& mesh, std::vector<uint32_t>& numbers, const Place& origin,
                  const Place& vertex) const;

  TileRange range_;
  int64_t columns_, rows_;
  std::vector<float> heights_;
  std::vector<bool> ground_;   ///< that the stream covers
  bool outline_ = false;       ///< the mesh follows the edge of the ground
  std::vector<float> errors_;  ///< of each vertex and all that need it
  float lowest_ = 0, highest_ = 0;
  double kept_ = 0;  ///< vertices of larger errors are in the mesh
};

}  // namespace tetrakis::tools
