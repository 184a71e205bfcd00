// SPDX-License-Identifier: Apache-2.0
// Sums over complete merging domains (thesis 3.3), by the octagons that they fill: sums over rows
// are differences of prefix sums.
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
