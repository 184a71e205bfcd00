// SPDX-License-Identifier: Apache-2.0
// Every store of bench_quadtree reads the nodes that a map of squares holds, on trees and forests
// of all densities.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <tuple>

#include "bench/meshes/quadtree_classics.hpp"

namespace tetrakis::bench {
namespace {

/// A forest whose squares are cut with a chance; heights tell its nodes apart.
QuadtreeNodes forest(QuadtreeShape shape, double chance, uint32_t seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution cut(chance);
  QuadtreeNodes data;
  data.shape = shape;
  std::vector<Square> level;
  for (uint32_t patch = 0; patch < shape.patches(); ++patch)
    level.push_back(shape.squareOf(0, patch));
  while (!level.empty()) {
    std::vector<Square> below;
    for (const Square square : level) {
      const auto height = static_cast<float>(data.nodes.size() + 1);
      data.nodes.push_back({square, {}, 1u << kCentre});
      data.nodes.back().values[kCentre] = height;
      const auto depth = static_cast<uint8_t>(square.level);
      data.entries.push_back(
          {{depth, QuadtreePlace::kNodes, kCentre, shape.nodeOf(square)}, height});
      if (square.level + 1 == shape.depth) continue;
      for (uint32_t child = 0; child < 4; ++child)
        if (cut(random))
          below.push_back(shape.squareOf(square.level + 1, 4 * shape.nodeOf(square) + child));
    }
    level = std::move(below);
  }
  return data;
}

template <class Store>
class QuadtreeStores : public testing::Test {};

struct NameOf {
  template <class Store>
  static std::string GetName(int) {
    return Store::kName;
  }
};

using Stores = testing::Types<SemilinearStore, PointerStore, LinearStore, HashStore, GridStore,
                              SametStore, GargantiniStore, SchrackStore>;
TYPED_TEST_SUITE(QuadtreeStores, Stores, NameOf);

TYPED_TEST(QuadtreeStores, WalkOverTheNodesOfAMap) {
  for (const auto& [shape, chance] : {std::pair(QuadtreeShape{1, 1, 1}, 1.0),
                                      {{1, 3, 2}, 1.0},
                                      {{2, 1, 1}, 0.5},
                                      {{4, 1, 1}, 1.0},
                                      {{5, 1, 1}, 0.7},
                                      {{6, 1, 1}, 0.4},
                                      {{4, 3, 2}, 0.6},
                                      {{3, 1, 4}, 1.0}}) {
    const QuadtreeNodes data = forest(shape, chance, shape.depth);
    std::map<std::tuple<uint32_t, uint32_t, uint32_t>, float> heights;
    for (const QuadtreeNode& node : data.nodes)
      heights[{node.square.level, node.square.column, node.square.row}] = node.values[kCentre];
    const TypeParam store(data);
    for (size_t i = 0; i < data.nodes.size(); ++i)
      for (const Direction direction :
           {Direction::kEast, Direction::kSouth, Direction::kWest, Direction::kNorth}) {
        Square square = data.nodes[i].square;
        float sum = 0;
        for (uint32_t steps = 1; steps <= 9; ++steps) {
          square = stepped(shape, square, direction);
          const auto at = heights.find({square.level, square.column, square.row});
          if (at != heights.end()) sum += at->second;
          if (steps != 1 && steps != 2 && steps != 9) continue;
          ASSERT_EQ(store.walk(store.handleOf(i), direction, steps), sum)
              << "node " << i << " of " << data.nodes.size() << ", depth " << shape.depth
              << ", direction " << static_cast<int>(direction) << ", steps " << steps;
        }
      }
  }
}

}  // namespace
}  // namespace tetrakis::bench
