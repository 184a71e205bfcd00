// SPDX-License-Identifier: Apache-2.0
// Forests with heights on them: fractal noise in space, so that sides that are glued agree.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/forest.hpp"
#include "bench/reproduction/solids.hpp"

namespace tetrakis::bench {

struct ForestTerrain {
  std::string name;
  Forest forest;
  std::vector<int32_t> heights;  ///< of the raster, 0 to kMost
  static constexpr int32_t kMost = 1 << 16;
};

/// Heights over the unit sphere.
ForestTerrain terrainOn(const Solid& solid, int depth);
/// A square of columns x columns patches whose opposite ends are glued to a torus.
ForestTerrain torusOf(uint32_t columns, int depth);
/// Two patches, each beyond all sides of the other, that the toroidal differences (4.2) and (4.4)
/// glue, as section 4.6 has it for an octahedron: no pair turns, and the surface is a torus.
ForestTerrain straightPair(int depth);

}  // namespace tetrakis::bench
