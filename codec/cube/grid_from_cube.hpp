// SPDX-License-Identifier: Apache-2.0
// gridFromCube() gives heights on a cube to the samples of a geographic grid, or of a window of it.
#pragma once

#include <cstdint>
#include <span>

#include "base/forest.hpp"
#include "base/plane.hpp"
#include "codec/cube/geographic_grid.hpp"

namespace tetrakis::inline cube {

/// A rectangle of samples of a grid, by its first column and row and its size. Columns may lie
/// behind the last one, where the first ones are.
struct GridWindow {
  uint32_t x, y;
  Extent extent;
};

/// Writes the window row by row. cube: of kCubeSides; heights: its raster.
void gridFromCube(const Forest& cube, std::span<const float> heights, const GeographicGrid& grid,
                  const GridWindow& window, uint32_t threads, std::span<float> out);

}  // namespace tetrakis::inline cube
