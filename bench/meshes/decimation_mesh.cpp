// SPDX-License-Identifier: Apache-2.0
// Rasterised meshes; see decimation_mesh.hpp.
#include "bench/meshes/decimation_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetrakis::bench {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

struct Surface {
  uint32_t width, height;
  std::vector<double> heights;
};

void draw(const std::array<std::array<float, 3>, 3>& corner, Surface& surface) {
  constexpr double kSlack = 1e-9;
  const double ax = corner[0][0], ay = corner[0][1];
  const double bx = corner[1][0] - ax, by = corner[1][1] - ay;
  const double cx = corner[2][0] - ax, cy = corner[2][1] - ay;
  const double area = bx * cy - cx * by;
  if (area == 0) return;
  const auto [left, right] = std::minmax({corner[0][0], corner[1][0], corner[2][0]});
  const auto [top, bottom] = std::minmax({corner[0][1], corner[1][1], corner[2][1]});
  const auto first = [](float v) {
    return static_cast<uint32_t>(std::max(0.0f, std::ceil(v - 0.001f)));
  };
  const auto last = [](float v, uint32_t size) {
    return static_cast<uint32_t>(std::clamp(v + 0.001f, 0.0f, static_cast<float>(size - 1)));
  };
  for (uint32_t y = first(top); y <= last(bottom, surface.height); ++y)
    for (uint32_t x = first(left); x <= last(right, surface.width); ++x) {
      const double px = x - ax, py = y - ay;
      const double u = (px * cy - py * cx) / area, v = (py * bx - px * by) / area;
      if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack) continue;
      double& height = surface.heights[size_t{y} * surface.width + x];
      height = std::max(height, (1 - u - v) * corner[0][2] + u * corner[1][2] + v * corner[2][2]);
    }
}

/// Breadth first from the covered samples.
void fillGaps(Surface& surface) {
  std::vector<size_t> queue;
  for (size_t i = 0; i < surface.heights.size(); ++i)
    if (surface.heights[i] != kNothing) queue.push_back(i);
  const size_t width = surface.width;
  for (size_t next = 0; next < queue.size(); ++next) {
    const size_t i = queue[next], x = i % width;
    const auto reach = [&](bool exists, size_t j) {
      if (!exists || surface.heights[j] != kNothing) return;
      surface.heights[j] = surface.heights[i];
      queue.push_back(j);
    };
    reach(x > 0, i - 1);
    reach(x + 1 < width, i + 1);
    reach(i >= width, i - width);
    reach(i + width < surface.heights.size(), i + width);
  }
}

}  // namespace

double rmse(const PlanMesh& mesh, const Raster& raster) {
  Surface surface{raster.width, raster.height, std::vector<double>(raster.pixels(), kNothing)};
  for (size_t t = 0; t < mesh.triangleCount(); ++t)
    draw({mesh.positions[mesh.triangles[3 * t]], mesh.positions[mesh.triangles[3 * t + 1]],
          mesh.positions[mesh.triangles[3 * t + 2]]},
         surface);
  fillGaps(surface);
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < surface.heights.size(); ++i) {
    if (!raster.real.empty() && !raster.real[i]) continue;
    const double error = surface.heights[i] - raster.samples[i];
    sum += error * error;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count)) * raster.unit;
}

Raster centralTile(const Raster& raster) {
  uint32_t side = 1025;
  while (side > std::min(raster.width, raster.height)) side = side / 2 + 1;
  return mirrorTo(raster, side, side);
}

}  // namespace tetrakis::bench
