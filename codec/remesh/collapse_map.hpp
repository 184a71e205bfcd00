// SPDX-License-Identifier: Apache-2.0
// CollapseMap keeps each collapse of a decimation: the flat polygon that the triangles before and
// after it tile. So a place of the mesh at any moment walks back, collapse by collapse, to the
// first mesh. Places on an edge walk to the same place from both sides: on the rim of a polygon
// weights are handed on as they are, and on an edge inside both sides find the same flat point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/ring_flattening.hpp"
#include "codec/remesh/shrinking_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

class CollapseMap {
 public:
  explicit CollapseMap(size_t triangles) : last_(triangles, kNone) {}

  /// The next collapse: the ring's centre goes to points[target]. `flat`: by `flatten()`.
  void add(const Ring& ring, uint32_t target, const std::vector<FlatPoint>& flat);

  uint32_t collapses() const { return static_cast<uint32_t>(collapses_.size()); }

  /// Moves corners to where a collapse moved them, and notes in `last` that it changed their
  /// triangles. Corners of triangles that vanish become kNone; returns how many do.
  uint32_t replay(uint32_t collapse, std::vector<Triangle>& triangles,
                  std::vector<uint32_t>& last) const;

  /// Takes a place behind a collapse that changed its triangle to where it was before. Returns the
  /// collapse before that changed the new triangle, or kNone.
  uint32_t undo(uint32_t collapse, SurfacePoint& place) const;

 private:
  struct Collapse {
    uint32_t first_spoke = 0;
    uint32_t to = 0;      // point
    uint32_t target = 0;  // its place in the ring
  };
  struct Spoke {
    uint32_t side = kNone;    // of the triangle to its left, from the centre; kNone: none
    uint32_t before = kNone;  // collapse that made this triangle
    FlatPoint place;
  };

  std::span<const Spoke> spokesOf(uint32_t collapse) const;

  std::vector<Collapse> collapses_;
  std::vector<Spoke> spokes_;
  std::vector<uint32_t> last_;  // collapse that changed each triangle
};

}  // namespace tetrakis::inline remesh
