// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/fitting/fitted_triangle.hpp"

#include <algorithm>

#include "codec/mesh/topology/triangle_samples.hpp"

namespace tetrakis::inline fitting {
namespace {

/// visit(WeighedSample) for every sample that counts in the triangle.
template <class Visit>
void forEachWeighed(const WeightedSurface& surface, const HeldTriangle& triangle, Visit&& visit) {
  const SurfaceView& grid = surface.view;
  std::array<double, 3> shares;  // of the samples on each edge
  for (size_t k = 0; k < 3; ++k) {
    const bool border =
        onBorder(grid, triangle.corners[(k + 1) % 3], triangle.corners[(k + 2) % 3]);
    shares[k] = border ? 1.0 : 0.5;
  }
  const TriangleSamples samples(triangle.corners);
  const auto area = static_cast<double>(samples.doubledArea());
  const std::array<double, 3>& h = triangle.heights;
  samples.forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
    if (std::count(e.begin(), e.end(), 0) == 2) return;  // a vertex stands apart
    const uint32_t sample = y * grid.width + x;
    double weight = surface.weightOf(sample);
    for (size_t k = 0; k < 3; ++k)
      if (e[k] == 0) weight *= shares[k];
    const double a = static_cast<double>(e[0]) / area, b = static_cast<double>(e[1]) / area,
                 p = static_cast<double>(e[2]) / area;
    const double z = grid.heights[sample];
    visit(WeighedSample{weight, a, b, p, a * (z - h[0]) + b * (z - h[1]) + p * (z - h[2])});
  });
}

}  // namespace

void add(TriangleMoments& t, const WeighedSample& s) {
  t.energy += s.weight * s.residual * s.residual;
  t.first.a += s.weight * s.residual * s.a;
  t.first.b += s.weight * s.residual * s.b;
  t.first.p += s.weight * s.residual * s.p;
  t.gram.aa += s.weight * s.a * s.a;
  t.gram.bb += s.weight * s.b * s.b;
  t.gram.pp += s.weight * s.p * s.p;
  t.gram.ab += s.weight * s.a * s.b;
  t.gram.ap += s.weight * s.a * s.p;
  t.gram.bp += s.weight * s.b * s.p;
}

bool onBorder(const SurfaceView& grid, GridPoint from, GridPoint to) {
  return (from.x == to.x && (from.x == 0 || from.x + 1 == grid.width)) ||
         (from.y == to.y && (from.y == 0 || from.y + 1 == grid.height));
}

TriangleMoments momentsOf(const WeightedSurface& surface, const HeldTriangle& triangle) {
  TriangleMoments moments;
  forEachWeighed(surface, triangle, [&](const WeighedSample& s) { add(moments, s); });
  return moments;
}

double squaredErrorOf(const WeightedSurface& surface, const HeldTriangle& triangle) {
  double energy = 0;
  forEachWeighed(surface, triangle,
                 [&](const WeighedSample& s) { energy += s.weight * s.residual * s.residual; });
  return energy;
}

}  // namespace tetrakis::inline fitting
