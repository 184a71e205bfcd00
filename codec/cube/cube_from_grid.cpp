// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/cube_from_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "codec/cube/completed_grid.hpp"
#include "codec/cube/cube_fit.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "codec/cube/grid_from_cube.hpp"

namespace tetrakis::inline cube {

namespace {

/// The grid's heights at the samples of a cube.
std::vector<float> interpolated(const GeographicGrid& grid, std::span<const float> heights,
                                const Forest& cube, uint32_t threads) {
  std::vector<float> samples(cube.raster().samples());
  const CompletedGrid completed(grid, heights);
  const uint32_t side = cube.side();
  std::vector<double> off(side);
  for (uint32_t x = 0; x < side; ++x) off[x] = offMiddle(static_cast<double>(x) / (side - 1));
  parallelFor(threads, size_t{kCubePatches} * side, [&](size_t row) {
    const auto patch = static_cast<uint32_t>(row / side);
    for (uint32_t x = 0; x < side; ++x) {
      const Geographic place = geographicOf(pointOf(patch, off[x], off[row % side]));
      samples[row * side + x] =
          completed.at(grid.columnOf(place.longitude), grid.rowOf(place.latitude));
    }
  });
  shareOwned<float>(cube, samples, side - 1);
  return samples;
}

ResamplingErrors errorsOf(const GeographicGrid& grid, std::span<const float> heights,
                          const Forest& cube, uint32_t threads, std::span<const float> samples) {
  std::vector<float> on_grid(heights.size());
  gridFromCube(cube, samples, grid, {0, 0, grid.extent()}, threads, on_grid);
  double largest = 0, squares = 0, area = 0;
  for (uint32_t y = 0; y < grid.extent().height; ++y) {
    double of_row = 0;
    const size_t first = size_t{y} * grid.extent().width;
    for (size_t i = first; i < first + grid.columnsRound(); ++i) {
      const double error = double{on_grid[i]} - heights[i];
      largest = std::max(largest, std::abs(error));
      of_row += error * error;
    }
    const double weight = cosineOfDegrees(grid.latitudeOf(y));
    squares += weight * of_row;
    area += weight * grid.columnsRound();
  }
  return {largest, std::sqrt(squares / area)};
}

}  // namespace

HeightsOnCube cubeFromGrid(const GeographicGrid& grid, std::span<const float> heights,
                           const Forest& cube, uint32_t threads) {
  std::vector<float> samples = interpolated(grid, heights, cube, threads);
  CubeFit(grid, cube, threads).improve(heights, samples);
  const ResamplingErrors errors = errorsOf(grid, heights, cube, threads, samples);
  return {std::move(samples), errors};
}

}  // namespace tetrakis::inline cube
