// SPDX-License-Identifier: Apache-2.0
// One descent over the forest: midpoints of split edges, planes where the forest overhangs.
#include "codec/mesh/study/local_errors.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/gains/clamped_triangle.hpp"
#include "codec/mesh/topology/triangle.hpp"

namespace tetrakis::inline study {
namespace {

struct Corner {
  GridPoint point;
};
using Triangle = LatticeTriangle<Corner>;

class LocalErrors {
 public:
  LocalErrors(const Lattice& lattice, const SurfaceView& surface)
      : lattice_(lattice), surface_(surface), errors_(lattice.vertexCount()) {}

  std::vector<double> build() {
    forEachRootTriangle(
        lattice_, [](GridPoint p) { return Corner{p}; }, [&](const Triangle& t) { descend(t); });
    return std::move(errors_);
  }

 private:
  /// Depth at most levelCount().
  void descend(const Triangle& t) {
    if (t.level == lattice_.levelCount() || t.collapses(lattice_)) return;
    const Corner w{t.splitPoint()};
    // A clamped vertex may lie in one of the two triangles of its diamond only.
    double& error = errors_[lattice_.id(lattice_.siteAt(t.level, w.point))];
    error =
        std::max(error, t.overhangs(lattice_) ? clampedErrorIn(t, w.point) : errorIn(t, w.point));
    descend(t.first(w));
    descend(t.second(w));
  }

  double heightAt(GridPoint p) const { return surface_.heights[lattice_.gridIndex(p)]; }

  double errorIn(const Triangle& t, GridPoint split) const {
    const double delta = heightAt(split) - 0.5 * (heightAt(t.a.point) + heightAt(t.b.point));
    return delta * delta * surface_.weightOf(lattice_.gridIndex(split));
  }

  double clampedErrorIn(const Triangle& t, GridPoint split) const {
    return clampedError(
        surface_,
        {lattice_.clamp(t.a.point), lattice_.clamp(t.b.point), lattice_.clamp(t.apex.point)},
        lattice_.clamp(split));
  }

  const Lattice& lattice_;
  const SurfaceView& surface_;
  std::vector<double> errors_;
};

}  // namespace

std::vector<double> localErrors(const Lattice& lattice, const SurfaceView& surface) {
  assert(surface.width == lattice.width() && surface.height == lattice.height());
  return LocalErrors(lattice, surface).build();
}

}  // namespace tetrakis::inline study
