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
  double share;  ///< of the samples on it

  int64_t at(int64_t x, int64_t y) const { return dx * (y - from_y) - dy * (x - from_x); }
};

Edge edgeOf(const SurfaceView& surface, GridPoint from, GridPoint to) {
  const auto both = [](uint32_t p, uint32_t q, uint32_t line) { return p == line && q == line; };
  const bool border = both(from.x, to.x, 0) || both(from.x, to.x, surface.width - 1) ||
                      both(from.y, to.y, 0) || both(from.y, to.y, surface.height - 1);
  return {from.x, from.y, int64_t{to.x} - from.x, int64_t{to.y} - from.y, border ? 1.0 : 0.5};
}

class ClampedTriangle {
 public:
  ClampedTriangle(const SurfaceView& surface, const std::array<GridPoint, 3>& corners)
      : surface_(surface), base_(heightAt(corners[0].x, corners[0].y)) {
    for (size_t k = 0; k < 3; ++k) {
      edges_[k] = edgeOf(surface, corners[(k + 1) % 3], corners[(k + 2) % 3]);
      rise_[k] = heightAt(corners[k].x, corners[k].y) - base_;
    }
    const int64_t area = edges_[0].at(corners[0].x, corners[0].y);
    assert(area != 0);
    sign_ = area < 0 ? -1 : 1;
    doubled_area_ = static_cast<double>(area * sign_);
  }

  struct Sample {
    double error = 0;  ///< squared residual times weight
    double share = 0;  ///< of the triangle in it; 0 outside
  };
  Sample at(uint32_t x, uint32_t y) const {
    double share = 1, plane = 0;
    for (size_t k = 0; k < 3; ++k) {
      const int64_t e = edges_[k].at(x, y) * sign_;
      if (e < 0) return {};
      if (e == 0) share = edges_[k].share;
      plane += static_cast<double>(e) * rise_[k];
    }
    const double residual = ((heightAt(x, y) - base_) * doubled_area_ - plane) / doubled_area_;
    return {residual * residual * surface_.weightOf(indexOf(x, y)), share};
  }

 private:
  size_t indexOf(uint32_t x, uint32_t y) const { return size_t{y} * surface_.width + x; }
  double heightAt(uint32_t x, uint32_t y) const { return surface_.heights[indexOf(x, y)]; }

  const SurfaceView& surface_;
  std::array<Edge, 3> edges_;
  std::array<double, 3> rise_;  ///< above corner 0: keeps the products small and exact on terrain
  double base_;
  int64_t sign_ = 1;
  double doubled_area_ = 0;
};

}  // namespace

double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners) {
  const ClampedTriangle triangle(surface, corners);
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  double energy = 0;
  for (uint32_t y = top; y <= bottom; ++y)
    for (uint32_t x = left; x <= right; ++x) {
      const ClampedTriangle::Sample sample = triangle.at(x, y);
      energy += sample.share * sample.error;
    }
  return energy;
}

double clampedError(const SurfaceView& surface, const std::array<GridPoint, 3>& corners,
                    GridPoint sample) {
  return ClampedTriangle(surface, corners).at(sample.x, sample.y).error;
}

}  // namespace tetrakis
