// SPDX-License-Identifier: Apache-2.0
// CollapseCost tells what it costs to collapse a point into a neighbour. The cost is the quadric
// error, with planes that stand upright on boundaries, plus a small part of the area around the
// point times the squared length of the edge, which makes triangles more even where the surface is
// flat. Where even triangles are wanted, penalties multiply this sum if triangles become slivers or
// a point gets many neighbours.
#pragma once

#include <vector>

#include "codec/remesh/quadric.hpp"
#include "codec/remesh/shrinking_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// What triangles are wanted for.
enum class DecimationAim {
  kEven,  ///< a base mesh, over whose triangles a surface lies
  kNear   ///< a surface of its own, of as few triangles as an error allows, without a map
};

class CollapseCost {
 public:
  /// `mesh` is the one that rings are taken of, before its first collapse. It fits in a cube of
  /// about side 1, and outlives this.
  CollapseCost(const TriangleMesh& mesh, DecimationAim aim);

  /// Sets costs[i] to what it costs to move the centre of the ring to its point i. The cost is
  /// infinite if a triangle would turn over or lose its area.
  void find(const ShrinkingMesh& shrinking, const Ring& ring, std::vector<double>& costs);

  /// To be called when the centre has moved to point `target` of the ring.
  void collapsed(const Ring& ring, uint32_t target);

 private:
  double shapePenalty(const Ring& ring, uint32_t target) const;

  const std::vector<Point>& points_;
  bool even_;
  std::vector<Quadric> quadrics_;
  // Of the ring that find() works on:
  std::vector<Point> normals_;
  double thinnest_ = 0;  // triangles of this quality are refused
};

}  // namespace tetrakis::inline remesh
