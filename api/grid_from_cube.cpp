// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/grid_from_cube.hpp"

#include <algorithm>

#include "api/decoder.hpp"
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

/// A window of a grid, and the cube that it is made of.
struct GridOfCube {
  Forest cube;
  GeographicGrid grid;
  GridWindow window;

  static Result<GridOfCube> make(uint32_t depth, const tks_geographic_grid* asked,
                                 const tks_window* part) {
    const Result<GeographicGrid> grid = gridOf(asked);
    if (!grid.ok()) return grid.status();
    const Result<Forest> cube = cubeOf(depth);
    if (!cube.ok()) return cube.status();
    const Result<GridWindow> window = windowOf(part, grid->extent());
    if (!window.ok()) return window.status();
    return GridOfCube{*cube, *grid, *window};
  }
  CubeWindows windows() const { return cubeWindows(cube, grid, window); }
};

Status makeGrid(const float* heights, uint32_t depth, const tks_geographic_grid* asked,
                const tks_window* part, uint32_t threads, float* out) {
  if (heights == nullptr) return {TKS_USAGE, "The heights of the cube are missing."};
  if (out == nullptr) return outputMissing();
  const Result<GridOfCube> made = GridOfCube::make(depth, asked, part);
  if (!made.ok()) return made.status();
  gridFromCube(made->cube, std::span(heights, made->cube.raster().samples()), made->grid,
               made->window, threads, {out, made->window.extent.samples()});
  return {};
}

tks_window given(const Window& window) {
  return {window.x, window.y, window.width, window.height};
}

Status giveWindows(uint32_t depth, const tks_geographic_grid* grid, const tks_window* part,
                   tks_window* out) {
  if (out == nullptr) return outputMissing();
  const Result<GridOfCube> made = GridOfCube::make(depth, grid, part);
  if (!made.ok()) return made.status();
  const CubeWindows windows = made->windows();
  std::transform(windows.begin(), windows.end(), out, given);
  return {};
}

/// Decodes the windows one after the other, as their own calls do.
Status decodeParts(tks_decoder& decoder, CubeParts& parts) {
  uint64_t beside = 0;
  for (const Window& part : parts.windows) beside += part.extent().samples() * sizeof(float);
  for (size_t patch = 0; patch < parts.windows.size(); ++patch) {
    if (parts.windows[patch].width == 0) continue;
    const tks_window part = given(parts.windows[patch]);
    tks_status status = tks_check_memory(&decoder, TKS_PART_HEIGHTS, &part, 0, beside, nullptr);
    if (status != TKS_OK) return {status, tks_message(&decoder)};
    std::vector<float>& heights = parts.heights[patch];
    heights.resize(parts.windows[patch].extent().samples());
    status = tks_decode_surface_window(&decoder, &part, heights.data(), heights.size());
    if (status != TKS_OK) return {status, tks_message(&decoder)};
  }
  return {};
}

Status decodeGrid(tks_decoder& decoder, const tks_geographic_grid* grid, const tks_window* part,
                  std::span<float> out) {
  if (out.data() == nullptr) return outputMissing();
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return noHeights();
  const SharedForest& forest = header.geometry->wavelet.forest;
  if (forest == nullptr) return {TKS_USAGE, "The heights do not lie on a cube."};
  if (Status status = checkCube(*forest); !status.ok()) return status;
  const auto depth = static_cast<uint32_t>(forest->depth() - decoder.heights_level);
  const Result<GridOfCube> made = GridOfCube::make(depth, grid, part);
  if (!made.ok()) return made.status();
  if (out.size() != made->window.extent.samples())
    return {TKS_USAGE, "The window of the grid has another number of samples."};
  CubeParts parts{made->windows(), {}};
  if (Status status = decodeParts(decoder, parts); !status.ok()) return status;
  gridFromCube(made->cube, parts, made->grid, made->window, decoder.threads, out);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_cube_windows(uint32_t depth, const tks_geographic_grid* grid,
                            const tks_window* window, tks_window* windows, char* message,
                            size_t message_size) {
  return tetrakis::reporting(message, message_size,
                             [&] { return tetrakis::giveWindows(depth, grid, window, windows); });
}

tks_status tks_decode_grid(tks_decoder* decoder, const tks_geographic_grid* grid,
                           const tks_window* window, float* out, size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::decodeGrid(*decoder, grid, window, {out, count});
  });
}

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
