// SPDX-License-Identifier: Apache-2.0
// cubeFromGrid() takes the heights of a geographic grid to a cube: those whose interpolation comes
// nearest to the grid, by least squares over the area of the Earth. So a cube that is coarser than
// the grid takes means, and one that is finer goes nearly through all samples. Where no sample of
// the grid is near, the cube has what lies between them (codec/cube/completed_grid.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "codec/cube/geographic_grid.hpp"

namespace tetrakis::inline cube {

/// How far heights on a cube, interpolated at the samples of a grid, are from those of the grid:
/// the largest distance, and the root of the mean square over the area of the Earth.
struct ResamplingErrors {
  double largest, rmse;
};

struct HeightsOnCube {
  std::vector<float> samples;  ///< the raster
  ResamplingErrors errors;
};

/// heights: finite, as many as the grid has. cube: of kCubeSides.
HeightsOnCube cubeFromGrid(const GeographicGrid& grid, std::span<const float> heights,
                           const Forest& cube, uint32_t threads);

}  // namespace tetrakis::inline cube
