// SPDX-License-Identifier: Apache-2.0
// vertexOrder() says in which order the places of vertices are told. Next is always a vertex that
// the most known triangles foretell, since means of several predictions are better than one (D.
// Cohen-Or, R. Cohen, R. Irony, "Multi-way geometry encoding", 2002).
#pragma once

#include <cstdint>
#include <vector>

#include "codec/trianglemesh/corner_fans.hpp"

namespace tetrakis::inline trianglemesh {

/// All vertices, numbers of fans. Takes time in proportion to the corners.
std::vector<uint32_t> vertexOrder(const std::vector<uint32_t>& sides, const CornerFans& fans);

}  // namespace tetrakis::inline trianglemesh
