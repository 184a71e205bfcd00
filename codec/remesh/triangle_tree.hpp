// SPDX-License-Identifier: Apache-2.0
// A TriangleTree finds the triangles of a mesh that are near a point or that a line crosses: a tree
// of boxes around them, cut by the surface area heuristic in bins along the longest axis (Wald, "On
// fast construction of SAH-based bounding volume hierarchies", 2007).
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "codec/remesh/triangle_mesh.hpp"
#include "codec/remesh/triangle_queries.hpp"

namespace tetrakis::inline remesh {

/// The least box, with sides along the axes, around some points; at first around none.
struct Box {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
};

class TriangleTree {
 public:
  /// `mesh` has finite points. It must stay alive and unchanged.
  explicit TriangleTree(const TriangleMesh& mesh);
  explicit TriangleTree(TriangleMesh&&) = delete;

  const TriangleMesh& mesh() const { return *mesh_; }

  /// The place of the mesh that is nearest to `point`, unless all are farther than `bound`. Of
  /// triangles at the same distance the first.
  std::optional<NearPlace> closest(const Point& point,
                                   double bound = std::numeric_limits<double>::infinity()) const;

  /// Hands every crossing of the line with a triangle to `visit`, in any order. A line through a
  /// side or a corner may cross several triangles there, and crosses one at least.
  void crossings(const Line& line, const std::function<void(const Crossing&)>& visit) const;

 private:
  struct Node {
    Box box;
    uint32_t first = 0;  ///< of a leaf, in order_; otherwise the first of two nodes
    uint32_t count = 0;  ///< of the triangles of a leaf; 0: no leaf
  };
  class Builder;

  const TriangleMesh* mesh_;
  std::vector<uint32_t> order_;  ///< triangles, those of a leaf one after the other
  std::vector<Node> nodes_;      ///< the root first
};

}  // namespace tetrakis::inline remesh
