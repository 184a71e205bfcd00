// SPDX-License-Identifier: Apache-2.0
// ForestQuadtree stores the vertices of a mesh of a forest in one semi-linear quadtree for each
// patch, each vertex once (thesis 4.5, 4.6).
//
// Two patches share the vertices of a glued side. They stand where they cost nothing: in the nodes
// of a patch that has its north or its west there. Only where both have their east or south there
// one of them, the first, needs its border tree. So the two hemispheres of an octahedron need none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/study/forest_traversal.hpp"

namespace tetrakis::inline study {

/// Where a vertex is stored: in the quadtree of a patch.
struct ForestPlace {
  uint32_t patch = 0;
  QuadtreePlace place;
  bool operator==(const ForestPlace&) const = default;
};

/// The place of the centre of a node.
ForestPlace centreOf(const ForestAdjacency& adjacency, const ForestNode& node);
/// The place of the midpoint of a side of a node: the node's own, or that of a neighbour.
ForestPlace midpointOf(const ForestAdjacency& adjacency, const ForestNode& node, Heading side);
/// The border trees that a forest needs, of two for each patch.
uint32_t borderTrees(const ForestAdjacency& adjacency);

class ForestQuadtree {
 public:
  /// vertices: a closed set. heights: of the raster of the forest.
  ForestQuadtree(const ForestLattice& lattice, std::span<const ForestVertex> vertices,
                 std::span<const float> heights);

  const ForestAdjacency& adjacency() const { return adjacency_; }
  const SemilinearQuadtree& patch(uint32_t patch) const { return trees_[patch]; }
  /// All that is stored but the corners of patches.
  uint32_t vertexCount() const;

  /// Whether a node is there: whether its centre is.
  bool has(const ForestNode& node) const { return find(centreOf(adjacency_, node)).has_value(); }
  /// The height of a vertex; none where it is not in the mesh.
  std::optional<float> find(const ForestPlace& place) const;
  /// The deepest node at a point of a patch, 0 … 2^depth in either direction; none where the patch
  /// has only its two triangles.
  std::optional<ForestNode> locate(uint32_t patch, double x, double y) const;

  /// The bytes of memory that values and tiles take.
  size_t bytes() const;

 private:
  ForestAdjacency adjacency_;
  std::vector<SemilinearQuadtree> trees_;
};

}  // namespace tetrakis::inline study
