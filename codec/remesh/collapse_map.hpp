// SPDX-License-Identifier: Apache-2.0
// CollapseMap keeps all collapses of a decimation. For each it keeps a flat polygon that both the
// triangles before the collapse and those after it tile. With these polygons a place of the mesh at
// any moment can be taken back, collapse by collapse, to the first mesh. A place on an edge gets
// the same result from both triangles of the edge: on the rim of a polygon its weights stay as they
// are, and inside the polygon both triangles give it the same flat point.
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

  /// Adds a collapse: the centre of the ring moves to its point `target`. `flat` is the result of
  /// flatten() for this ring, or empty if the collapse will only be done again, not undone.
  void add(const Ring& ring, uint32_t target, const std::vector<FlatPoint>& flat);

  uint32_t collapses() const { return static_cast<uint32_t>(collapses_.size()); }

  /// Does a collapse again: sets the corners that it moved, and the entries of `last` of the
  /// triangles that it changed. All corners of triangles that vanish become kNone. Returns the
  /// number of these triangles.
  uint32_t replay(uint32_t collapse, std::vector<Triangle>& triangles,
                  std::vector<uint32_t>& last) const;

  /// Takes a place on a triangle that the collapse changed back to where it was before the
  /// collapse. Returns the last earlier collapse that changed the triangle where it is now, or
  /// kNone.
  uint32_t undo(uint32_t collapse, SurfacePoint& place) const;

 private:
  struct Collapse {
    uint32_t first_spoke = 0;
    uint32_t to = 0;      // point into which the centre collapsed
    uint32_t target = 0;  // number of this point in the ring
  };
  /// The line from the centre of a ring to one of its points.
  struct Spoke {
    uint32_t side = kNone;    // half-edge of the triangle to its left; kNone: there is none
    uint32_t before = kNone;  // last collapse that changed this triangle before
    FlatPoint place;          // of the point
  };

  std::span<const Spoke> spokesOf(uint32_t collapse) const;

  std::vector<Collapse> collapses_;
  std::vector<Spoke> spokes_;
  std::vector<uint32_t> last_;  // for each triangle the last collapse that changed it
};

}  // namespace tetrakis::inline remesh
