// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/grid_from_cube.hpp"

#include <algorithm>
#include <cassert>

#include "base/parallel.hpp"
#include "codec/cube/cube_interpolation.hpp"
#include "codec/cube/grid_on_cube.hpp"

namespace tetrakis::inline cube {

namespace {

/// samples: as CubeInterpolation takes them.
template <class Samples>
void interpolate(const Forest& cube, const Samples& samples, const GeographicGrid& grid,
                 const GridWindow& window, uint32_t threads, std::span<float> out) {
  const CubeInterpolation interpolation(cube);
  const uint32_t width = window.extent.width;
  const GridOnCube places(grid, window.x, width);
  parallelFor(threads, window.extent.height, [&](size_t row) {
    const uint32_t y = window.y + static_cast<uint32_t>(row);
    places.forEach(y, [&](uint32_t column, const CubePlace& place) {
      out[row * width + column] = interpolation.at(samples, interpolation.cellAt(place));
    });
  });
}

/// The samples of a raster that lie in parts of it.
class PartSamples {
 public:
  PartSamples(const CubeParts& parts, uint32_t side) : parts_(parts), side_(side) {}

  float operator[](uint32_t sample) const {
    const uint32_t row = sample / side_, patch = row / side_;
    const Window& part = parts_.windows[patch];
    const uint32_t x = sample % side_ - part.x, y = row - part.y;
    assert(x < part.width && y < part.height);
    return parts_.heights[patch][size_t{y} * part.width + x];
  }

 private:
  const CubeParts& parts_;
  uint32_t side_;
};

}  // namespace

void gridFromCube(const Forest& cube, std::span<const float> heights, const GeographicGrid& grid,
                  const GridWindow& window, uint32_t threads, std::span<float> out) {
  interpolate(cube, heights, grid, window, threads, out);
}

void gridFromCube(const Forest& cube, const CubeParts& parts, const GeographicGrid& grid,
                  const GridWindow& window, uint32_t threads, std::span<float> out) {
  interpolate(cube, PartSamples(parts, cube.side()), grid, window, threads, out);
}

CubeWindows cubeWindows(const Forest& cube, const GeographicGrid& grid, const GridWindow& window) {
  const CubeInterpolation interpolation(cube);
  const GridOnCube places(grid, window.x, window.extent.width);
  const uint32_t side = cube.side();
  CubeWindows windows{};
  const auto add = [&](uint32_t sample) {
    const uint32_t x = sample % side, y = sample / side;
    Window& part = windows[y / side];
    if (part.width == 0) part = {x, y, 1, 1};
    const uint32_t left = std::min(part.x, x), top = std::min(part.y, y);
    part = {left, top, std::max(part.x + part.width, x + 1) - left,
            std::max(part.y + part.height, y + 1) - top};
  };
  for (uint32_t y = window.y; y < window.y + window.extent.height; ++y) {
    places.forEach(y, [&](uint32_t, const CubePlace& place) {
      interpolation.taps(interpolation.cellAt(place)).forEach([&](uint32_t sample, float) {
        add(sample);
      });
    });
  }
  return windows;
}

}  // namespace tetrakis::inline cube
