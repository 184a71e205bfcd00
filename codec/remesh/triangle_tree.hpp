// SPDX-License-Identifier: Apache-2.0
// A TriangleTree finds the triangles of a mesh that are near a point or that a line crosses. It is
// a binary tree of boxes around triangles. A node is cut in two across its longest axis, where the
// surface area heuristic expects the cheapest search among some evenly spaced cuts (Wald, "On fast
// construction of SAH-based bounding volume hierarchies", 2007).
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "codec/remesh/node_bounds.hpp"
#include "codec/remesh/triangle_mesh.hpp"
#include "codec/remesh/triangle_queries.hpp"

namespace tetrakis::inline remesh {

class TriangleTree {
 public:
  /// `mesh` has finite points. It must stay alive and unchanged. together: the tree does not part
  /// so many triangles that follow on each other; above 1 it is built in less time, for meshes in
  /// which these lie side by side.
  explicit TriangleTree(const TriangleMesh& mesh, uint32_t together = 1);
  explicit TriangleTree(TriangleMesh&&, uint32_t together = 1) = delete;

  const TriangleMesh& mesh() const { return *mesh_; }

  /// The place of the mesh that is nearest to `point`, or nothing if all places are farther away
  /// than `bound`. Of several triangles at the same distance the one with the lowest number counts.
  std::optional<NearPlace> closest(const Point& point,
                                   double bound = std::numeric_limits<double>::infinity()) const;

  /// Calls `visit` with every crossing of the line with a triangle, in any order. A line that goes
  /// through a side or a corner crosses at least one of the triangles there, and may cross several.
  void crossings(const Line& line, const std::function<void(const Crossing&)>& visit) const;

 private:
  struct Node {
    Box box;
    uint32_t turned = kNone;  ///< number of its turned box, if it has one
    uint32_t first = 0;  ///< of a leaf: its first place in order_; else the first of two children
    uint32_t count = 0;  ///< number of runs of a leaf; 0: the node is not a leaf
  };
  class Builder;

  const TurnedBox* turnedOf(const Node& node) const {
    return node.turned == kNone ? nullptr : &turned_[node.turned];
  }

  /// Calls visit(triangle) with the triangles of a leaf.
  template <class Visit>
  void forEachOf(const Node& leaf, const Visit& visit) const;

  const TriangleMesh* mesh_;
  uint32_t together_;            ///< triangles of a run
  std::vector<uint32_t> order_;  ///< all runs; those of a leaf are next to each other
  std::vector<Node> nodes_;      ///< node 0 is the root
  std::vector<TurnedBox> turned_;
};

}  // namespace tetrakis::inline remesh
