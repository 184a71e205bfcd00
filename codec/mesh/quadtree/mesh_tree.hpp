// SPDX-License-Identifier: Apache-2.0
// MeshTree holds an adaptive 4-8 mesh in a semi-linear quadtree and gives the part of it that a
// view sees.
//
// The tree holds the closed set of vertices and their heights; triangles follow from it. A node
// whose centre c is present is a fan of triangles around c. Each side of its square is one triangle
// or, if its midpoint is present, two; and where a child is present (which takes both midpoints
// beside it) its own fan stands for the two triangles in that quadrant:
//
//   nw---n---ne    side nw-sw: (nw, sw, c), or (nw, w, c) unless the north-western child is there
//   | \  |  / |                and (w, sw, c) unless the south-western child is there
//   w----c----e
//   | /  |  \ |    n and w are the node's own, s and e those of its neighbours or of a border tree:
//   sw---s---se    since both sides of an edge ask for the same midpoint, there are no T-junctions.
#pragma once

#include <span>
#include <vector>

#include "codec/mesh/quadtree/index_differences.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/quadtree/view_raster.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline quadtree {

/// A part of a mesh. vertices: those of its triangles, in the order of the tree (parents before
/// children). heights: one for each vertex.
struct ViewMesh {
  LatticeMesh mesh;
  std::vector<float> heights;
};

class MeshTree {
 public:
  /// vertices: a closed set, as for meshOf(). heights: of the vertices of meshOf(), in its order.
  MeshTree(Lattice lattice, std::span<const VertexId> vertices, std::span<const float> heights);

  const Lattice& lattice() const { return lattice_; }
  const SemilinearQuadtree& quadtree() const { return quadtree_; }

  /// Returns the triangles that may touch the polygon (convex, in samples, within the grid): all
  /// that touch it, and those in the same quadrants of their nodes. The time is linear in the size
  /// of the result and the rows of the polygon, plus one bit for each vertex of the tree.
  ViewMesh view(std::span<const MapPoint> polygon) const;
  /// Returns the whole mesh, that of meshOf() in another order.
  ViewMesh whole() const;

 private:
  Lattice lattice_;
  IndexDifferences differences_;
  SemilinearQuadtree quadtree_;
};

/// Where the quadtree of the lattice stores a vertex.
QuadtreePlace placeOf(const Lattice& lattice, Site v);

}  // namespace tetrakis::inline quadtree
