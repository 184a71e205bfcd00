// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/needless_vertices.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace tetrakis::inline mesh {

namespace {

/// For each sample how many of those left of it and above it, itself included, differ from the one
/// before them in their row or column.
class Changes {
 public:
  explicit Changes(const SurfaceView& surface)
      : stride_(size_t{surface.width} + 1), sums_(stride_ * (size_t{surface.height} + 1)) {
    const int32_t* here = surface.heights.data();
    for (uint32_t y = 0; y < surface.height; ++y) {
      uint32_t row = 0;
      for (uint32_t x = 0; x < surface.width; ++x, ++here) {
        const bool left = x > 0 && here[0] != here[-1];
        const bool above = y > 0 && here[0] != *(here - surface.width);
        row += left || above;
        sums_[(y + size_t{1}) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + row;
      }
    }
  }

  /// From first to last, both included.
  bool none(GridPoint first, GridPoint last) const {
    const size_t above = first.y * stride_, below = (last.y + size_t{1}) * stride_;
    return sums_[below + last.x + 1] - sums_[above + last.x + 1] ==
           sums_[below + first.x] - sums_[above + first.x];
  }

 private:
  size_t stride_;
  std::vector<uint32_t> sums_;
};

}  // namespace

std::vector<VertexId> withoutNeedless(const Lattice& lattice, const SurfaceView& surface,
                                      std::vector<VertexId> vertices) {
  assert(surface.width == lattice.width() && surface.height == lattice.height());
  const Changes changes(surface);
  std::erase_if(vertices, [&](VertexId v) {
    const Site site = lattice.site(v);
    const GridPoint at = lattice.position(site);
    // The octagon of the vertex (topology/octagon.hpp), and one triangle beyond.
    const uint32_t reach = (Lattice::isCentre(site.level) ? 3 : 2) * lattice.plan(site.level).step;
    const GridPoint first{at.x - std::min(at.x, reach), at.y - std::min(at.y, reach)};
    return changes.none(lattice.clamp(first), lattice.clamp({at.x + reach, at.y + reach}));
  });
  return vertices;
}

}  // namespace tetrakis::inline mesh
