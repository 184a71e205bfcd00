// SPDX-License-Identifier: Apache-2.0
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
#pragma once

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

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

}  // namespace tetrakis::inline topology
