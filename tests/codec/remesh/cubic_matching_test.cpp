// SPDX-License-Identifier: Apache-2.0
// Matchings are as large as those that trying everything finds.
#include "codec/remesh/cubic_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "tests/codec/remesh/small_meshes.hpp"

namespace tetrakis {
namespace {

/// About one and a half sides a node at most, in a random order.
CubicGraph randomGraph(uint32_t nodes, uint32_t tries, std::mt19937& random) {
  CubicGraph graph(nodes, {kNoMate, kNoMate, kNoMate});
  for (; tries > 0; --tries) {
    const uint32_t a = below(random, nodes), b = below(random, nodes);
    const auto free_a = std::find(graph[a].begin(), graph[a].end(), kNoMate);
    const auto free_b = std::find(graph[b].begin(), graph[b].end(), kNoMate);
    if (a == b || free_a == graph[a].end() || free_b == graph[b].end()) continue;
    if (std::find(graph[a].begin(), graph[a].end(), b) != graph[a].end()) continue;
    *free_a = b;
    *free_b = a;
  }
  return graph;
}

/// The most nodes that pairs and nodes alone can hold, by dynamic programming over sets of nodes.
int mostNodes(const CubicGraph& graph, const std::vector<bool>& may_be_alone) {
  std::vector<int> most(size_t{1} << graph.size());
  for (size_t set = 1; set < most.size(); ++set) {
    const auto node = static_cast<size_t>(std::countr_zero(set));
    const size_t rest = set & (set - 1);
    most[set] = most[rest] + may_be_alone[node];
    for (const uint32_t mate : graph[node]) {
      if (mate == kNoMate || (rest >> mate & 1) == 0) continue;
      most[set] = std::max(most[set], 2 + most[rest & ~(size_t{1} << mate)]);
    }
  }
  return most.back();
}

/// Pairs, nodes alone and nodes without mates. Checks that mates are neighbours.
std::array<int, 3> counted(const CubicGraph& graph, const std::vector<bool>& may_be_alone,
                           const Matching& matching) {
  std::array<int, 3> counts{};
  for (uint32_t node = 0; node < graph.size(); ++node) {
    const uint32_t mate = matching[node];
    if (mate == kNoMate) {
      ++counts[2];
    } else if (mate == node) {
      EXPECT_TRUE(may_be_alone[node]);
      ++counts[1];
    } else {
      EXPECT_EQ(matching[mate], node);
      EXPECT_NE(std::find(graph[node].begin(), graph[node].end(), mate), graph[node].end());
      if (mate > node) ++counts[0];
    }
  }
  return counts;
}

/// Pairs of neighbours that are free, in the order of the nodes.
Matching greedy(const CubicGraph& graph) {
  Matching matching(graph.size(), kNoMate);
  for (uint32_t node = 0; node < graph.size(); ++node) {
    for (const uint32_t mate : graph[node]) {
      if (mate == kNoMate || matching[node] != kNoMate || matching[mate] != kNoMate) continue;
      matching[node] = mate;
      matching[mate] = node;
    }
  }
  return matching;
}

TEST(CubicMatchings, HaveAsManyPairsAsCanBe) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const uint32_t nodes = 2 + below(random, 12);
    const CubicGraph graph = randomGraph(nodes, nodes * (1 + below(random, 4)), random);
    const std::vector<bool> none(nodes);
    const int most = mostNodes(graph, none);
    for (Matching matching : {Matching(nodes, kNoMate), greedy(graph)}) {
      completeMatching(graph, none, matching);
      const auto [pairs, alone, unmatched] = counted(graph, none, matching);
      EXPECT_EQ(2 * pairs, most);
      EXPECT_EQ(alone, 0);
    }
  }
}

TEST(CubicMatchings, LeaveAloneOnlyWhereAllPairsAreTaken) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const uint32_t nodes = 2 + below(random, 12);
    const CubicGraph graph = randomGraph(nodes, nodes * (1 + below(random, 4)), random);
    std::vector<bool> may_be_alone(nodes);
    for (uint32_t node = 0; node < nodes; ++node) may_be_alone[node] = below(random, 4) == 0;
    Matching matching(nodes, kNoMate);
    completeMatching(graph, may_be_alone, matching);
    const auto [pairs, alone, unmatched] = counted(graph, may_be_alone, matching);
    EXPECT_EQ(2 * pairs, mostNodes(graph, std::vector<bool>(nodes)));
    EXPECT_EQ(2 * pairs + alone, mostNodes(graph, may_be_alone));
    EXPECT_EQ(2 * pairs + alone + unmatched, static_cast<int>(nodes));
  }
}

TEST(CubicMatchings, KeepNodesMatched) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const CubicGraph graph = randomGraph(500, 900, random);
    const Matching start = greedy(graph);
    Matching matching = start;
    completeMatching(graph, std::vector<bool>(500), matching);
    for (size_t node = 0; node < 500; ++node) {
      EXPECT_TRUE(start[node] == kNoMate || matching[node] != kNoMate);
    }
  }
}

TEST(CubicMatchings, OfLongPathsAndCombsAreQuick) {
  // A path of odd length whose greedy pairs are all wrong; a comb, most of whose teeth are odd.
  constexpr uint32_t kNodes = 60000;
  CubicGraph path(kNodes, {kNoMate, kNoMate, kNoMate}), comb = path;
  for (uint32_t node = 0; node + 1 < kNodes; ++node) {
    path[node][0] = node + 1;
    path[node + 1][1] = node;
    if (node % 3 != 0) continue;  // node - node + 1, node - node + 2: two teeth
    comb[node] = {node + 1, node + 2, kNoMate};
    comb[node + 1][0] = comb[node + 2][0] = node;
  }
  Matching matching(kNodes, kNoMate);
  for (uint32_t node = 1; node + 2 < kNodes; node += 2) {
    matching[node] = node + 1;
    matching[node + 1] = node;
  }
  completeMatching(path, std::vector<bool>(kNodes), matching);
  EXPECT_EQ(counted(path, std::vector<bool>(kNodes), matching)[0], kNodes / 2);
  Matching teeth(kNodes, kNoMate);
  completeMatching(comb, std::vector<bool>(kNodes), teeth);
  EXPECT_EQ(counted(comb, std::vector<bool>(kNodes), teeth)[0], kNodes / 3);
}

}  // namespace
}  // namespace tetrakis
