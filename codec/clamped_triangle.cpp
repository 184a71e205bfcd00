// SPDX-License-Identifier: Apache-2.0
// Edge functions (Pineda 1988): e_k is twice the area that a sample spans with the edge opposite
// corner k.
#include "codec/clamped_triangle.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis {
namespace {

struct Edge {
  int64_t from_x, from_y, dx, dy;
  double weight;  ///< of the samples on it

  int64_t at(int64_t x, int64_t y) const { return dx * (y - from_y) - dy * (x - from_x); }
};

Edge edgeOf(const SurfaceView& surface, GridPoint from, GridPoint to) {
  const auto both = [](uint32_t p, uint32_t q, uint32_t line) { return p == line && q == line; };
  const bool border = both(from.x, to.x, 0) || both(from.x, to.x, surface.width - 1) ||
                      both(from.y, to.y, 0) || both(from.y, to.y, surface.height - 1);
  return {from.x, from.y, int64_t{to.x} - from.x, int64_t{to.y} - from.y, border ? 1.0 : 0.5};
}

}  // namespace

double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners) {
  const auto heightAt = [&](uint32_t x, uint32_t y) -> double {
    return surface.heights[size_t{y} * surface.width + x];
  };
  std::array<Edge, 3> edges;
  std::array<double, 3> rise;  // above corner 0: keeps the products small and exact on terrain
  const double base = heightAt(corners[0].x, corners[0].y);
  for (size_t k = 0; k < 3; ++k) {
    edges[k] = edgeOf(surface, corners[(k + 1) % 3], corners[(k + 2) % 3]);
    rise[k] = heightAt(corners[k].x, corners[k].y) - base;
  }
  const int64_t area = edges[0].at(corners[0].x, corners[0].y);
  assert(area != 0);
  const int64_t sign = area < 0 ? -1 : 1;
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  double energy = 0;
  for (uint32_t y = top; y <= bottom; ++y)
    for (uint32_t x = left; x <= right; ++x) {
      double weight = 1, plane = 0;
      bool inside = true;
      for (size_t k = 0; k < 3; ++k) {
        const int64_t e = edges[k].at(x, y) * sign;
        inside = inside && e >= 0;
        if (e == 0) weight = edges[k].weight;
        plane += static_cast<double>(e) * rise[k];
      }
      if (!inside) continue;
      const double doubled_area = static_cast<double>(area * sign);
      const double residual = ((heightAt(x, y) - base) * doubled_area - plane) / doubled_area;
      energy += weight * residual * residual;
    }
  return energy;
}

}  // namespace tetrakis
