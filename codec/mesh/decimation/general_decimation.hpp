// SPDX-License-Identifier: Apache-2.0
// generalDecimation() orders all vertices by general decimation with global error (thesis 5.2.2):
// from full resolution down, each step removes the merging domain M_v (v and its remaining
// descendants) that costs least, lambda(v) = -deltaD / deltaR (5.2): squared error per triangle, or
// per unit of another cost.
#pragma once

#include <vector>

#include "codec/mesh/decimation/merging_domains.hpp"
#include "codec/mesh/decimation/vertex_costs.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline decimation {

/// Returns all vertices, those removed last first. gains: one for each vertex (gains/gains.hpp).
/// prompt_levels (merging_domains.hpp) changes the time that decimation takes, but not the order.
/// steps: takes the number of vertices that each step removes, first step first; nullptr: none.
std::vector<VertexId> generalDecimation(const std::vector<double>& gains, const VertexCosts& costs,
                                        uint32_t prompt_levels = MergingDomains::kPromptLevels,
                                        std::vector<uint32_t>* steps = nullptr);

}  // namespace tetrakis::inline decimation
