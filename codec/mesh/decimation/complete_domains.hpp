// SPDX-License-Identifier: Apache-2.0
// completeDomains() sums the gains and costs of vertices over the complete merging domain of every
// vertex (thesis 3.3), with which decimation begins. A domain fills an octagon, and a sum over a
// row of it is a difference of two prefix sums.
#pragma once

#include <vector>

#include "codec/mesh/decimation/vertex_costs.hpp"
#include "codec/mesh/decimation/worth.hpp"

namespace tetrakis::inline decimation {

/// Returns u(M_v) of every vertex v while no vertex is removed. gains: one for each vertex; their
/// sums are exact in any order (gains/gains.hpp).
std::vector<DomainWorth> completeDomains(const std::vector<double>& gains,
                                         const VertexCosts& costs);

}  // namespace tetrakis::inline decimation
