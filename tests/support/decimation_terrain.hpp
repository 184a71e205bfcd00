// SPDX-License-Identifier: Apache-2.0
// Small terrains, and the surfaces of meshes over them computed the slow way.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::checks {

enum class Relief { kFlat, kPlane, kTerrain, kNoise, kSteps, kExtreme };

/// Integer arithmetic and minstd only: the same heights everywhere.
struct Terrain {
  uint32_t width, height;
  std::vector<int32_t> heights;
  std::vector<float> weights;  ///< empty: 1

  Terrain(uint32_t w, uint32_t h, Relief relief) : width(w), height(h), heights(size_t{w} * h) {
    for (uint32_t y = 0; y < h; ++y)
      for (uint32_t x = 0; x < w; ++x) heights[size_t{y} * w + x] = sample(relief, x, y);
  }
  SurfaceView view() const { return {width, height, heights, weights}; }

 private:
  std::minstd_rand random_{1};

  int32_t sample(Relief relief, uint32_t x, uint32_t y) {
    const auto noise = static_cast<int32_t>(random_() % 2001) - 1000;
    const auto i = static_cast<int32_t>(x), j = static_cast<int32_t>(y);
    switch (relief) {
      case Relief::kFlat:
        return 42;
      case Relief::kPlane:
        return 7 * i - 3 * j + 100;
      case Relief::kTerrain:
        return 5 * i * i - 3 * i * j + 40 * std::abs(3 * i - 5 * j) + noise / 20;
      case Relief::kNoise:
        return noise;
      case Relief::kSteps:
        return (i / 5 + j / 3) % 3 * 1000;
      case Relief::kExtreme:
        return noise < 0 ? std::numeric_limits<int32_t>::min()
                         : std::numeric_limits<int32_t>::max();
    }
    return 0;
  }
};

inline constexpr std::initializer_list<Relief> kReliefs = {Relief::kFlat,    Relief::kPlane,
                                                           Relief::kTerrain, Relief::kNoise,
                                                           Relief::kSteps,   Relief::kExtreme};
inline const std::vector<std::pair<uint32_t, uint32_t>> kSizes = {
    {2, 2}, {2, 9},  {3, 3},  {3, 8},   {5, 5},  {9, 9},
    {6, 6}, {7, 10}, {11, 6}, {12, 12}, {13, 4}, {10, 19}};

/// Heights of the mesh at every sample; all triangles that hold a sample have to agree on it.
inline std::vector<double> heightsOf(const LatticeMesh& mesh, const Terrain& terrain) {
  std::vector<double> surface(terrain.heights.size(), std::nan(""));
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<double, 3> x, y, z;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t sample = mesh.vertices[mesh.triangles[3 * t + k]];
      x[k] = sample % terrain.width;
      y[k] = sample / terrain.width;
      z[k] = terrain.heights[sample];
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    for (size_t i = 0; i < surface.size(); ++i) {
      const double px = static_cast<double>(i % terrain.width) - x[0];
      const double py = static_cast<double>(i / terrain.width) - y[0];
      const double u = (px * (y[2] - y[0]) - py * (x[2] - x[0])) / area;
      const double v = (py * (x[1] - x[0]) - px * (y[1] - y[0])) / area;
      if (u < -1e-12 || v < -1e-12 || u + v > 1 + 1e-12) continue;
      const double plane = z[0] + u * (z[1] - z[0]) + v * (z[2] - z[0]);
      const double scale = std::abs(z[0]) + std::abs(z[1]) + std::abs(z[2]) + 1;
      EXPECT_FALSE(std::abs(surface[i] - plane) > 1e-12 * scale) << "a crack";
      surface[i] = plane;
    }
  }
  return surface;
}

inline double bruteForceError(const LatticeMesh& mesh, const Terrain& terrain) {
  const std::vector<double> surface = heightsOf(mesh, terrain);
  double error = 0;
  for (size_t i = 0; i < surface.size(); ++i) {
    const double residual = terrain.heights[i] - surface[i];
    error += residual * residual * terrain.view().weightOf(i);
  }
  return error;
}

}  // namespace tetrakis::checks
