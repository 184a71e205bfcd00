// SPDX-License-Identifier: Apache-2.0
// A maximum matching of a graph whose nodes have at most three neighbours: as many pairs of
// neighbours as there can be, by the blossoms of Edmonds ("Paths, trees, and flowers", 1965).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tetrakis::inline remesh {

constexpr uint32_t kNoMate = ~uint32_t{0};

/// For each node its neighbours; kNoMate fills up places. If a node names another one as neighbour,
/// that one names it too.
using CubicGraph = std::vector<std::array<uint32_t, 3>>;

/// For each node its mate: a neighbour, or the node itself if it is matched alone, or kNoMate if it
/// has no mate.
using Matching = std::vector<uint32_t>;

/// Adds pairs to `matching` until there are as many as there can be. No node may be alone in it
/// before. A node that has a mate may get another one, but does not lose it. Then nodes that still
/// have no mate get one if they, or others in their stead, may be alone. No more nodes are alone
/// than the greatest number of pairs leaves over.
void completeMatching(const CubicGraph& graph, const std::vector<bool>& may_be_alone,
                      Matching& matching);

}  // namespace tetrakis::inline remesh
