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

}  // namespace tetrakis::bench
