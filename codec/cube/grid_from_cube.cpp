// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/grid_from_cube.hpp"

#include "base/parallel.hpp"
#include "codec/cube/cube_interpolation.hpp"
#include "codec/cube/grid_on_cube.hpp"

namespace tetrakis::inline cube {

void gridFromCube(const Forest& cube, std::span<const float> heights, const GeographicGrid& grid,
                  const GridWindow& window, uint32_t threads, std::span<float> out) {
  const CubeInterpolation interpolation(cube);
  const uint32_t width = window.extent.width;
  const GridOnCube places(grid, window.x, width);
  parallelFor(threads, window.extent.height, [&](size_t row) {
    const uint32_t y = window.y + static_cast<uint32_t>(row);
    places.forEach(y, [&](uint32_t column, const CubePlace& place) {
      out[row * width + column] = interpolation.at(heights, interpolation.cellAt(place));
    });
  });
}

}  // namespace tetrakis::inline cube
