// SPDX-License-Identifier: Apache-2.0
// Meshes of any program over a raster, and their error on its samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/peers/raster.hpp"

namespace tetrakis::bench {

/// positions: column, row, height in sample steps. Triangles of either orientation; they may
/// overlap or leave gaps.
struct PlanMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<uint32_t> triangles;  ///< three indices each

  size_t triangleCount() const { return triangles.size() / 3; }
};

/// Root mean squared error over the real samples, in the raster's unit. Where triangles overlap the
/// highest counts, where there is none the nearest covered sample.
double rmse(const PlanMesh& mesh, const Raster& raster);

/// Largest square of side 2^d + 1 around the centre, at most 1025: what Martini can do.
Raster centralTile(const Raster& raster);

}  // namespace tetrakis::bench
