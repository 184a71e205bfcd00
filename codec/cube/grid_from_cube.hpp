// SPDX-License-Identifier: Apache-2.0
// gridFromCube() gives heights on a cube to the samples of a geographic grid, or of a window of it,
// for which only the heights of cubeWindows() have to be there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "base/plane.hpp"
#include "base/view.hpp"
#include "codec/cube/cube_sphere.hpp"
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

/// For each patch a window of the raster of a cube; without samples where none is needed.
using CubeWindows = std::array<Window, kCubePatches>;

/// The least windows that hold all heights which gridFromCube() reads.
CubeWindows cubeWindows(const Forest& cube, const GeographicGrid& grid, const GridWindow& window);

/// The heights of such windows.
struct CubeParts {
  CubeWindows windows;
  std::array<std::vector<float>, kCubePatches> heights;
};

/// The same of parts of a cube.
void gridFromCube(const Forest& cube, const CubeParts& parts, const GeographicGrid& grid,
                  const GridWindow& window, uint32_t threads, std::span<float> out);

}  // namespace tetrakis::inline cube
