// SPDX-License-Identifier: Apache-2.0
// The arguments of calls that concern a globe: its ellipsoid, a geographic grid, and the depth of a
// cube.
#pragma once

#include <cstddef>
#include <string>

#include "api/guarded.hpp"
#include "base/forest.hpp"
#include "bitstream/stream/header.hpp"
#include "codec/cube/cube_interpolation.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "codec/cube/geographic_grid.hpp"
#include "codec/mesh/globe/globe_places.hpp"

namespace tetrakis::inline api {

/// With usual values in the place of 0. TKS_USAGE with a sentence.
Result<tks_globe> takeGlobe(const tks_globe* given);

inline Spheroid spheroidOf(const tks_globe& globe) {
  return {globe.semi_major, globe.semi_minor};
}

/// Where the samples of a grid lie; degrees: of the globe. TKS_USAGE with a sentence about `what`:
/// it does not go round, or beyond a pole.
Result<GlobePlaces> placesOn(const tks_globe& globe, const std::string& what,
                             const Placement& place, Extent grid);

/// Metres that a height of 1 is drawn as.
double metresPerHeight(const tks_globe& globe, const StreamHeader& header);

/// TKS_USAGE unless the patches of the heights are those of a cube.
Status checkCube(const Forest& forest);

inline Result<GeographicGrid> gridOf(const tks_geographic_grid* given) {
  constexpr uint32_t kMostSide = 1 << 20;
  if (given == nullptr) return Status(TKS_USAGE, "The grid is missing.");
  tks_geographic_grid grid;
  if (Status taken = takeSized("the grid", *given, sizeof grid, grid); !taken.ok()) return taken;
  if (grid.width > kMostSide || grid.height > kMostSide)
    return Status(TKS_USAGE, "A grid has at most 1048576 columns and rows.");
  return GeographicGrid::make({grid.width, grid.height}, std::to_array(grid.geotransform));
}

inline Result<Forest> cubeOf(uint32_t depth) {
  static_assert(kMostCubeDepth == TKS_MOST_CUBE_DEPTH);
  if (depth < 1 || depth > TKS_MOST_CUBE_DEPTH)
    return Status(TKS_USAGE, "The depth of a cube is 1 to 14.");
  return cubeForest(static_cast<int>(depth));
}

}  // namespace tetrakis::inline api
