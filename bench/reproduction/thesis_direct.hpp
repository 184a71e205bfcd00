// SPDX-License-Identifier: Apache-2.0
// General decimation as its definition says it, without the updates of thesis 5.3: what
// proposition 5.1 is measured against.
#pragma once

#include <vector>

#include "codec/mesh/decimation/worth.hpp"

namespace tetrakis::bench {

/// The same order as generalDecimation(). Every step looks at the slopes of all vertices, and after
/// it the domain of every ancestor of what was removed is summed up anew: Θ(n²) time.
std::vector<VertexId> directDecimation(const std::vector<double>& gains, const VertexCosts& costs);

}  // namespace tetrakis::bench
