// SPDX-License-Identifier: Apache-2.0
// Orders of single vertices with fixed slopes: what the thesis compares general decimation with
// (2.5.2, 5.4.2, 5.5.2), and a quick one.
#pragma once

#include <vector>

#include "codec/mesh/lattice.hpp"
#include "codec/mesh/vertex_costs.hpp"

namespace tetrakis {

/// Restricted decimation: from full resolution down, each step removes the vertex of least slope
/// among those without remaining descendants (|M_v| = 1). All vertices, those removed last first.
/// errors: of each vertex, what its removal costs; may be negative.
std::vector<VertexId> restrictedDecimation(const std::vector<double>& errors,
                                           const VertexCosts& costs);

/// Refinement: from the roots up, each step inserts the vertex of greatest slope among those whose
/// parents are there; what costs nothing first. All vertices, in this order.
std::vector<VertexId> refinement(const std::vector<double>& errors, const VertexCosts& costs);

/// By saturated slopes (Ohlberger and Rumpf 1999): of a vertex, the greatest among its own and
/// those of its descendants. Parents before children, greatest first, as many vertices as cost
/// `most` or more in all. What is worth little is told almost as well as by general decimation, in
/// a fraction of the time.
std::vector<VertexId> saturatedOrder(const std::vector<double>& errors, const VertexCosts& costs,
                                     uint64_t most);

}  // namespace tetrakis
