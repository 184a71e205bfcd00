// SPDX-License-Identifier: Apache-2.0
// meshOf() takes a closed set of vertices of the lattice and returns the triangles of their mesh.
// LatticeTriangle, TriangleSamples and Octagon are the shapes that all computations on such meshes
// walk over: triangles and their halves, the samples in them, and merging domains.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

// Octagon is the shape of a complete merging domain on one pair of levels (thesis 3.3), so that
// sums over a domain need no list of its vertices.
//
// Let t be the step of a pair of levels (squares and midpoints), and the step of the pair of v be
// 2^k t. As seen from v, in units of t, M_v holds the midpoints of that pair with
//
//   |dx|, |dy| <= X,  |dx| + |dy| <= Y      v a centre:    X = 3 * 2^k - 2,  Y = 4 * 2^k - 3
//                                           v a midpoint:  X = 2 * 2^k - 2,  Y = 3 * 2^k - 3
//
// and the centres with X - 1, Y - 1. (A midpoint is a parent of centres that lie one step away
// along both axes, a centre one of midpoints one step away along either axis; X and Y follow by
// induction.) Where the border of the grid cuts the octagon, M_v is the part inside: the lattice is
// its own mirror image at the border, so a path of descendants that leaves the grid has a mirror
// image inside.

struct Octagon {
  int64_t x, y;  ///< X, Y

  /// The octagon of the midpoints 2^k times finer than the pair of a vertex on this level.
  static Octagon ofMidpoints(uint32_t level, uint32_t k) {
    const int64_t scale = int64_t{1} << k;
    if (Lattice::isCentre(level)) return {3 * scale - 2, 4 * scale - 3};
    return {2 * scale - 2, 3 * scale - 3};
  }
  static Octagon ofCentres(uint32_t level, uint32_t k) {
    const Octagon midpoints = ofMidpoints(level, k);
    return {midpoints.x - 1, midpoints.y - 1};
  }

  /// Greatest |dx| in the row dy, |dy| <= X.
  int64_t reach(int64_t dy) const { return std::min(x, y - (dy < 0 ? -dy : dy)); }
};

// LatticeTriangle is a triangle of the 4-8 lattice and gives the two halves into which its vertex
// splits it. The triangles form binary trees under the two triangles of every root square. A split
// runs from the apex to the midpoint of the hypotenuse (thesis 3.2.1):
//
//          apex                     apex
//         /    \                   / |  \        first:  (apex, a, w)
//        /      \        =>       /  |   \       second: (b, apex, w)
//       /        \               /   |    \      Seen from above a, b, apex run counter-clockwise
//      b----------a             b----w-----a     (x to the right, rows towards the viewer).
//
// Corner is any type with a GridPoint `point` (on the lattice, before clamping), so that users
// carry along what they need of a corner.

template <class Corner>
struct LatticeTriangle {
  Corner a, b, apex;
  uint32_t level =
      0;  ///< of the vertex that splits it; levelCount() for triangles of full resolution

  GridPoint splitPoint() const {
    return {(a.point.x + b.point.x) / 2, (a.point.y + b.point.y) / 2};
  }
  LatticeTriangle first(const Corner& w) const { return {apex, a, w, level + 1}; }
  LatticeTriangle second(const Corner& w) const { return {b, apex, w, level + 1}; }
  bool collapses(const Lattice& lattice) const {
    return lattice.collapses(a.point, b.point, apex.point);
  }
  bool overhangs(const Lattice& lattice) const {
    return lattice.overhangs(a.point, b.point, apex.point);
  }
};

/// visit(nw, sw, se, ne, turned) for every root square; corners are GridPoints. The diagonal runs
/// from nw to se, or from sw to ne if turned.
template <class Visit>
void forEachRootSquare(const Lattice& lattice, Visit&& visit) {
  const uint32_t side = lattice.rootSide();
  for (uint32_t row = 0; row < lattice.rootRows(); ++row)
    for (uint32_t column = 0; column < lattice.rootColumns(); ++column) {
      const uint32_t x = column * side, y = row * side;
      visit(GridPoint{x, y}, GridPoint{x, y + side}, GridPoint{x + side, y + side},
            GridPoint{x + side, y}, (row + column) % 2 == 1);
    }
}

/// visit(LatticeTriangle) for both triangles of every root square; makeCorner(GridPoint) -> Corner.
template <class MakeCorner, class Visit>
void forEachRootTriangle(const Lattice& lattice, MakeCorner&& makeCorner, Visit&& visit) {
  using Triangle = LatticeTriangle<decltype(makeCorner(GridPoint()))>;
  forEachRootSquare(lattice, [&](GridPoint p, GridPoint q, GridPoint r, GridPoint s, bool turned) {
    const auto nw = makeCorner(p), sw = makeCorner(q), se = makeCorner(r), ne = makeCorner(s);
    visit(turned ? Triangle{sw, ne, nw} : Triangle{se, nw, sw});
    visit(turned ? Triangle{ne, sw, se} : Triangle{nw, se, ne});
  });
}

// TriangleSamples visits the samples in a triangle, row by row, with their edge functions (Pineda
// 1988): e_k is twice the area that a sample spans with the edge opposite corner k; the three add
// up to twice the triangle's area. Samples on an edge belong to the triangle.

class TriangleSamples {
 public:
  using Edges = std::array<int64_t, 3>;

  /// Corners in either sense of rotation; the triangle has an area.
  explicit TriangleSamples(const std::array<GridPoint, 3>& corners) {
    for (size_t k = 0; k < 3; ++k) {
      const GridPoint from = corners[(k + 1) % 3], to = corners[(k + 2) % 3];
      across_[k] = int64_t{from.y} - to.y;
      down_[k] = int64_t{to.x} - from.x;
      origin_[k] = -(across_[k] * from.x + down_[k] * from.y);
    }
    const int64_t area = at(corners[0].x, corners[0].y)[0], sign = area < 0 ? -1 : 1;
    assert(area != 0);
    doubled_area_ = area * sign;
    for (size_t k = 0; k < 3; ++k) {
      across_[k] *= sign;
      down_[k] *= sign;
      origin_[k] *= sign;
    }
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    left_ = left;
    right_ = right;
    top_ = top;
    bottom_ = bottom;
  }

  int64_t doubledArea() const { return doubled_area_; }
  /// Edge functions of a sample; one that is negative says that the sample lies beyond that edge.
  Edges at(int64_t x, int64_t y) const {
    Edges e;
    for (size_t k = 0; k < 3; ++k) e[k] = across_[k] * x + down_[k] * y + origin_[k];
    return e;
  }

  /// visit(x, y, Edges)
  template <class Visit>
  void forEach(Visit&& visit) const {
    for (uint32_t y = top_; y <= bottom_; ++y) {
      int64_t first = left_, last = right_;
      const Edges row = at(0, y);
      for (size_t k = 0; k < 3; ++k) {
        if (across_[k] > 0) first = std::max(first, -floorDivide(row[k], across_[k]));
        if (across_[k] < 0) last = std::min(last, floorDivide(row[k], -across_[k]));
      }
      Edges e = at(first, y);
      for (int64_t x = first; x <= last; ++x) {
        visit(static_cast<uint32_t>(x), y, e);
        for (size_t k = 0; k < 3; ++k) e[k] += across_[k];
      }
    }
  }

 private:
  static int64_t floorDivide(int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

  Edges across_, down_, origin_;  ///< e = across x + down y + origin
  int64_t doubled_area_;
  uint32_t left_, right_, top_, bottom_;
};

// meshOf() lists the triangles of the conforming 4-8 mesh that a closed set of lattice vertices
// implies (thesis 3.2).

/// A mesh that covers the grid. `vertices` are samples (row * width + column): first the roots, row
/// by row, then the inserted vertices in their order; no sample comes twice. `triangles` are three
/// indices into `vertices` each, counter-clockwise seen from above (x to the right, rows towards
/// the viewer); every triangle has an area.
struct LatticeMesh {
  std::vector<uint32_t> vertices;
  std::vector<uint32_t> triangles;

  size_t triangleCount() const { return triangles.size() / 3; }
};

/// Returns the mesh of the roots and `vertices`. Each vertex comes once, after its parents.
LatticeMesh meshOf(const Lattice& lattice, std::span<const VertexId> vertices);

/// Returns all vertices, coarse ones first. Their mesh has every sample.
std::vector<VertexId> allVertices(const Lattice& lattice);

/// The closure of all samples whose mark is not zero (thesis 3.2.3: splitting domains), in order of
/// id. marks: one for each sample, row by row.
std::vector<VertexId> codedVertices(const Lattice& lattice, std::span<const uint8_t> marks);

/// Returns the mesh of codedVertices().
LatticeMesh codedMesh(const Lattice& lattice, std::span<const uint8_t> marks);

}  // namespace tetrakis::inline topology
