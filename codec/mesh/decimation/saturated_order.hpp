// SPDX-License-Identifier: Apache-2.0
// saturatedOrder() sorts vertices by saturated slopes, from the error and the cost of each. Where
// vertices are worth little the order is nearly as good as that of general decimation, and takes a
// fraction of its time.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/mesh/decimation/vertex_costs.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline decimation {

/// Sorts vertices by saturated slopes (Ohlberger and Rumpf 1999): the saturated slope of a vertex
/// is the greatest among its own and those of its descendants. Returns vertices in falling order of
/// these slopes, parents before children, as many as cost `most` or more in all.
/// errors: what the removal of each vertex costs; an error may be negative.
std::vector<VertexId> saturatedOrder(const std::vector<double>& errors, const VertexCosts& costs,
                                     uint64_t most);

}  // namespace tetrakis::inline decimation
