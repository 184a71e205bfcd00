// SPDX-License-Identifier: Apache-2.0
// facets() makes heights that are linear between points, like those of a triangulated survey.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

/// Where points lie on a square grid, `spacing` samples apart, and each of its cells is two
/// triangles. A point has the first bits of hash(column, row, seed) as its height, in 2^-4.
inline double facetAt(double x, double y, double spacing, uint32_t seed) {
  const double u = x / spacing, v = y / spacing;
  const auto column = static_cast<uint32_t>(u), row = static_cast<uint32_t>(v);
  const double a = u - column, b = v - row;
  const auto point = [&](uint32_t right, uint32_t down) {
    return (hash(column + right, row + down, seed) >> 20) / 16.;
  };
  const double first = point(0, 0), last = point(1, 1);
  const double corner = a > b ? point(1, 0) : point(0, 1);
  return a > b ? first + a * (corner - first) + b * (last - corner)
               : first + b * (corner - first) + a * (last - corner);
}

/// Floats of such a surface.
inline Raster facets(uint32_t width, uint32_t height, double spacing, uint32_t seed = 91) {
  Raster raster{width, height, 1, TKS_F32, {}};
  raster.data.resize(size_t{width} * height * sizeof(float));
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const auto sample = static_cast<float>(facetAt(x, y, spacing, seed));
      std::memcpy(raster.data.data() + (size_t{y} * width + x) * sizeof sample, &sample,
                  sizeof sample);
    }
  }
  return raster;
}

}  // namespace tetrakis::samples
