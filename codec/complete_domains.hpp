// SPDX-License-Identifier: Apache-2.0
// Sums over complete merging domains (thesis 3.3), by the octagons that they fill.
//
// Let t be the step of a pair of levels (squares and midpoints), and the step of the pair of v be
// 2^k t. As seen from v, in units of t, M_v holds the midpoints of that pair with
//
//   |dx|, |dy| <= X,  |dx| + |dy| <= Y      v a centre:    X = 3 * 2^k - 2,  Y = 4 * 2^k - 3
//                                           v a midpoint:  X = 2 * 2^k - 2,  Y = 3 * 2^k - 3
//
// and the centres with X - 1, Y - 1. (Midpoints reach centres by a step along both axes, centres
// midpoints by a step along either; X and Y follow by induction.) Nothing is lost where a border
// cuts the octagon: the lattice is its own mirror image there, and so detours across the border
// have mirror images within. Sums over rows are differences of prefix sums.
#pragma once

#include <vector>

#include "codec/vertex_costs.hpp"
#include "codec/worth.hpp"

namespace tetrakis {

/// u(M_v) of every vertex v, nothing being removed. gains: one for each vertex, their sums exact in
/// any order (gains.hpp).
std::vector<DomainWorth> completeDomains(const std::vector<double>& gains,
                                         const VertexCosts& costs);

}  // namespace tetrakis
