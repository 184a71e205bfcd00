// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/grid_from_cube.hpp"

#include "api/globe.hpp"

namespace tetrakis::inline api {
namespace {

/// Columns go on behind the last one.
Result<GridWindow> windowOf(const tks_window* given, const Extent& grid) {
  if (given == nullptr) return GridWindow{0, 0, grid};
  if (given->width == 0 || given->height == 0 || given->x >= grid.width ||
      given->y >= grid.height || given->width > grid.width ||
      given->height > grid.height - given->y)
    return Status(TKS_USAGE, "The window does not lie in the grid, or holds no sample.");
  return GridWindow{given->x, given->y, {given->width, given->height}};
}

Status makeGrid(const float* heights, uint32_t depth, const tks_geographic_grid* asked,
                const tks_window* part, uint32_t threads, float* out) {
  if (heights == nullptr) return {TKS_USAGE, "The heights of the cube are missing."};
  if (out == nullptr) return outputMissing();
  const Result<GeographicGrid> grid = gridOf(asked);
  if (!grid.ok()) return grid.status();
  const Result<Forest> cube = cubeOf(depth);
  if (!cube.ok()) return cube.status();
  const Result<GridWindow> window = windowOf(part, grid->extent());
  if (!window.ok()) return window.status();
  gridFromCube(*cube, {heights, cube->raster().samples()}, *grid, *window, threads,
               {out, window->extent.samples()});
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

const uint32_t* tks_cube_sides(void) {
  return tetrakis::kCubeSides.data();
}

uint32_t tks_cube_depth(uint32_t width) {
  uint32_t depth = 1;
  while (depth < TKS_MOST_CUBE_DEPTH && (uint64_t{4} << depth) < width) ++depth;
  return depth;
}

tks_status tks_grid_from_cube(const float* cube, uint32_t depth, const tks_geographic_grid* grid,
                              const tks_window* window, uint32_t threads, float* out, char* message,
                              size_t message_size) {
  return tetrakis::reporting(message, message_size, [&] {
    return tetrakis::makeGrid(cube, depth, grid, window, threads, out);
  });
}
