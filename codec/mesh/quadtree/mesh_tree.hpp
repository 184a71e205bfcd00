// SPDX-License-Identifier: Apache-2.0
// MeshTree keeps a mesh in a quadtree and returns the part of it that a camera sees, in time that
// follows that part and not the mesh. ViewRaster tells which nodes of the quadtree the camera may
// see.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/quadtree/location_code.hpp"
#include "codec/mesh/quadtree/semilinear_quadtree.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline quadtree {

// ViewRaster rasterises the ground that a view sees into the nodes of the quadtree (thesis 4.7:
// visibility).
//
// Seen from above a view is a convex polygon. In every level the nodes that it touches fill one
// span of columns in each row. The finest spans come from the polygon's edges; those of two rows
// united and halved are the spans of the level above. So whether a node may be seen is one
// comparison with a span, and the nodes of a level that may be seen lie on one traversal path a
// row.

/// A place on the map, in samples.
struct MapPoint {
  double x = 0, y = 0;
};

/// The ground, 0 ... right by 0 ... bottom, and the range of the heights on it.
struct MapBox {
  double right = 0, bottom = 0;
  double low = 0, high = 0;

  /// The box of a grid and of the finite ones among its heights: voids are NaN, and a scale and an
  /// offset may make heights overflow.
  static MapBox around(uint32_t width, uint32_t height, std::span<const float> heights);
};

/// The convex polygon of ground at some height within the box that a camera may see: where
/// -w <= x <= w and -w <= y <= w for some height. clip: 4 x 4, row by row, takes (x, y, height, 1)
/// to clip coordinates; its third row is not used. Matrix and box are finite. Empty if there is
/// none.
std::vector<MapPoint> viewFootprint(const std::array<double, 16>& clip, const MapBox& box);

class ViewRaster {
 public:
  /// Columns first ... last of a row; none if first > last.
  struct Span {
    uint32_t first = 1, last = 0;
  };

  /// polygon: convex, within 0 ... columns * 2^depth by 0 ... rows * 2^depth.
  ViewRaster(QuadtreeShape shape, std::span<const MapPoint> polygon);

  /// Levels go down to `depth`, whose squares are those of single samples.
  Span span(uint32_t level, uint32_t row) const {
    const Rows& rows = levels_[level];
    const uint32_t i = row - rows.first;  // rows before the first wrap around to large numbers
    return i < rows.spans.size() ? rows.spans[i] : Span{};
  }
  bool touches(Square s) const {
    const Span seen = span(s.level, s.row);
    return seen.first <= s.column && s.column <= seen.last;
  }
  /// Rows of a level with spans: firstRow ... endRow - 1.
  uint32_t firstRow(uint32_t level) const { return levels_[level].first; }
  uint32_t endRow(uint32_t level) const {
    return levels_[level].first + static_cast<uint32_t>(levels_[level].spans.size());
  }

 private:
  struct Rows {
    uint32_t first = 0;
    std::vector<Span> spans;

    void widen(uint32_t row, Span by);
  };

  void addEdge(MapPoint p, MapPoint q, Rows& rows, const QuadtreeShape& shape) const;

  std::vector<Rows> levels_;
};

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
