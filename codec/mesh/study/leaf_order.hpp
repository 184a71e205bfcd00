// SPDX-License-Identifier: Apache-2.0
// restrictedDecimation() and refinement() order single vertices by fixed slopes. The thesis
// compares general decimation with these orders (2.5.2, 5.4.2, 5.5.2).
#pragma once

#include <vector>

#include "codec/mesh/decimation/vertex_costs.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline study {

/// Restricted decimation: from full resolution down, each step removes the vertex of least slope
/// among those without remaining descendants (|M_v| = 1). All vertices, those removed last first.
/// errors: of each vertex, what its removal costs; may be negative.
std::vector<VertexId> restrictedDecimation(const std::vector<double>& errors,
                                           const VertexCosts& costs);

/// Refinement: from the roots up, each step inserts the vertex of greatest slope among those whose
/// parents are there; what costs nothing first. All vertices, in this order.
std::vector<VertexId> refinement(const std::vector<double>& errors, const VertexCosts& costs);

}  // namespace tetrakis::inline study
