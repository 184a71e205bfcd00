// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/cube_from_grid.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "api/globe.hpp"

namespace tetrakis::inline api {
namespace {

/// Sums over the heights around have to remain finite.
constexpr float kLargestHeight = 1e30f;

Status makeCube(const tks_geographic_grid* given, const float* heights, uint32_t depth,
                uint32_t threads, float* out, ResamplingErrors& errors) {
  if (heights == nullptr) return {TKS_USAGE, "The heights of the grid are missing."};
  if (out == nullptr) return outputMissing();
  const Result<GeographicGrid> grid = gridOf(given);
  if (!grid.ok()) return grid.status();
  const Result<Forest> cube = cubeOf(depth);
  if (!cube.ok()) return cube.status();
  const std::span<const float> samples(heights, grid->extent().samples());
  const auto is_height = [](float height) { return std::abs(height) <= kLargestHeight; };
  if (!std::all_of(samples.begin(), samples.end(), is_height))
    return {TKS_USAGE, "A cube has no voids: the grid must have a height everywhere."};
  const HeightsOnCube made = cubeFromGrid(*grid, samples, *cube, threads);
  std::copy(made.samples.begin(), made.samples.end(), out);
  errors = made.errors;
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_cube_from_grid(const tks_geographic_grid* grid, const float* heights, uint32_t depth,
                              uint32_t threads, float* cube, double* largest_error, double* rmse,
                              char* message, size_t message_size) {
  return tetrakis::reporting(message, message_size, [&] {
    tetrakis::ResamplingErrors errors = {};
    tetrakis::Status made = tetrakis::makeCube(grid, heights, depth, threads, cube, errors);
    if (made.ok() && largest_error != nullptr) *largest_error = errors.largest;
    if (made.ok() && rmse != nullptr) *rmse = errors.rmse;
    return made;
  });
}
