// SPDX-License-Identifier: Apache-2.0
// What it costs to collapse a point into a neighbour: the quadric error, with planes upright on
// boundaries; a little of area times squared length, which evens out triangles where the surface is
// flat; and penalties for slivers and for points with many neighbours.
#pragma once

#include <vector>

#include "codec/remesh/quadric.hpp"
#include "codec/remesh/shrinking_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

class CollapseCost {
 public:
  /// `mesh`: no longer than about 1, and the numbers of its triangles those of the rings; outlives
  /// this.
  explicit CollapseCost(const TriangleMesh& mesh);

  /// For each point of the ring what it costs to move the centre there; infinite where a triangle
  /// would turn over or have no area.
  void find(const ShrinkingMesh& shrinking, const Ring& ring, std::vector<double>& costs);

  /// The centre has gone to points[target].
  void collapsed(const Ring& ring, uint32_t target);

 private:
  double shapePenalty(const Ring& ring, uint32_t target) const;

  const std::vector<Point>& points_;
  std::vector<Quadric> quadrics_;
  // Of the ring in work:
  std::vector<Point> normals_;
  double thinnest_ = 0;  // quality that is refused
};

}  // namespace tetrakis::inline remesh
