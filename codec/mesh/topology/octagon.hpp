// SPDX-License-Identifier: Apache-2.0
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
#pragma once

#include <algorithm>
#include <cstdint>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

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

}  // namespace tetrakis::inline topology
