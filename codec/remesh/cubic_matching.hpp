// SPDX-License-Identifier: Apache-2.0
// A maximum matching of a graph whose nodes have at most three neighbours: as many pairs of
// neighbours as there can be, by the blossoms of Edmonds ("Paths, trees, and flowers", 1965).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tetrakis::inline remesh {

constexpr uint32_t kNoMate = ~uint32_t{0};

/// Of each node the neighbours, kNoMate where there is none. Neighbours know one another.
using CubicGraph = std::vector<std::array<uint32_t, 3>>;

/// Of each node the mate, a neighbour; itself, if it is matched alone; kNoMate, if it has none.
using Matching = std::vector<uint32_t>;

/// Adds pairs to `matching`, in which none is alone, until there are as many as there can be. Nodes
/// that had mates keep having some. Then matches as many as possible of the nodes without mates by
/// leaving alone others that may be: no more nodes than the greatest number of pairs demands.
void completeMatching(const CubicGraph& graph, const std::vector<bool>& may_be_alone,
                      Matching& matching);

}  // namespace tetrakis::inline remesh
