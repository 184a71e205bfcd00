// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/gains/clamped_triangle.hpp"

#include <cassert>

#include "codec/mesh/topology/triangle_samples.hpp"

namespace tetrakis::inline gains {
namespace {

double shareOnEdge(const SurfaceView& surface, GridPoint from, GridPoint to) {
  const auto both = [](uint32_t p, uint32_t q, uint32_t line) { return p == line && q == line; };
  const bool border = both(from.x, to.x, 0) || both(from.x, to.x, surface.width - 1) ||
                      both(from.y, to.y, 0) || both(from.y, to.y, surface.height - 1);
  return border ? 1.0 : 0.5;
}

class ClampedTriangle {
 public:
  ClampedTriangle(const SurfaceView& surface, const std::array<GridPoint, 3>& corners)
      : surface_(surface), samples_(corners), base_(heightAt(corners[0].x, corners[0].y)) {
    for (size_t k = 0; k < 3; ++k) {
      shares_[k] = shareOnEdge(surface, corners[(k + 1) % 3], corners[(k + 2) % 3]);
      rise_[k] = heightAt(corners[k].x, corners[k].y) - base_;
    }
  }

  const TriangleSamples& samples() const { return samples_; }
  /// The share that the triangle has of a sample that lies in it.
  double share(const TriangleSamples::Edges& e) const {
    double share = 1;
    for (size_t k = 0; k < 3; ++k)
      if (e[k] == 0) share = shares_[k];
    return share;
  }
  /// Squared residual times weight.
  double error(uint32_t x, uint32_t y, const TriangleSamples::Edges& e) const {
    const auto area = static_cast<double>(samples_.doubledArea());
    double plane = 0;
    for (size_t k = 0; k < 3; ++k) plane += static_cast<double>(e[k]) * rise_[k];
    const double residual = ((heightAt(x, y) - base_) * area - plane) / area;
    return residual * residual * surface_.weightOf(indexOf(x, y));
  }

 private:
  size_t indexOf(uint32_t x, uint32_t y) const { return size_t{y} * surface_.width + x; }
  double heightAt(uint32_t x, uint32_t y) const { return surface_.heights[indexOf(x, y)]; }

  const SurfaceView& surface_;
  TriangleSamples samples_;
  std::array<double, 3> shares_;  ///< of the samples on each edge
  std::array<double, 3> rise_;    ///< above corner 0: keeps the products small and exact on terrain
  double base_;
};

}  // namespace

double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners) {
  for ([[maybe_unused]] const GridPoint& p : corners)
    assert(p.x < surface.width && p.y < surface.height);
  const ClampedTriangle triangle(surface, corners);
  double energy = 0;
  triangle.samples().forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
    energy += triangle.share(e) * triangle.error(x, y, e);
  });
  return energy;
}

double clampedError(const SurfaceView& surface, const std::array<GridPoint, 3>& corners,
                    GridPoint sample) {
  const ClampedTriangle triangle(surface, corners);
  const TriangleSamples::Edges e = triangle.samples().at(sample.x, sample.y);
  return (e[0] | e[1] | e[2]) < 0 ? 0 : triangle.error(sample.x, sample.y, e);
}

}  // namespace tetrakis::inline gains
