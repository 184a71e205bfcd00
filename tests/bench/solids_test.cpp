// SPDX-License-Identifier: Apache-2.0
// Steps between the quadtrees of a solid lead to the nodes that lie there in space.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "bench/reproduction/solids.hpp"
#include "codec/mesh/study/forest_traversal.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::bench {
namespace {

std::vector<Solid> solids() {
  return {tetrahedron(), octahedron(), icosahedron(), tetrakisHexahedron()};
}

/// A point that others are equal to but for rounding.
using Key = std::tuple<int64_t, int64_t, int64_t>;

Key keyOf(const Point& p) {
  const auto rounded = [](double v) { return std::llround(v * 1e7); };
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

/// x, y: halves of the node's side from its north-western corner.
Key pointOfNode(const Solid& solid, const ForestNode& node, int x, int y) {
  const auto [level, column, row] = node.square;
  const double halves = std::ldexp(2, static_cast<int>(level));
  return keyOf(pointOf(solid, node.patch, (2 * column + x) / halves, (2 * row + y) / halves));
}

Key middleOf(const Solid& solid, const ForestNode& node, uint32_t side) {
  constexpr int kX[] = {1, 2, 1, 0}, kY[] = {0, 1, 2, 1};
  return pointOfNode(solid, node, kX[side], kY[side]);
}

template <class Visit>
void forEachNode(uint32_t patches, uint32_t level, const Visit& visit) {
  for (uint32_t patch = 0; patch < patches; ++patch)
    for (uint32_t row = 0; row < 1u << level; ++row)
      for (uint32_t column = 0; column < 1u << level; ++column)
        visit(ForestNode{patch, {level, column, row}});
}

TEST(Solids, AreGluedAsTheThesisGluesThem) {
  EXPECT_EQ(sidesOf(octahedron()), test::octahedronShape().sides);
  EXPECT_EQ(sidesOf(tetrakisHexahedron()), test::cubeShape().sides);
  for (const Solid& solid : solids()) {
    const std::vector<uint32_t> sides = sidesOf(solid);
    ASSERT_TRUE(Forest::isSound(sides)) << solid.name;
    for (const uint32_t side : sides) ASSERT_NE(side, Forest::kBorder) << solid.name;
  }
}

// Section 4.6 leads from one hemisphere to the other by (4.2) and (4.4), the toroidal differences.
TEST(Solids, TwoPatchesWithToroidalDifferencesAreATorus) {
  const Forest forest(3, {6, 7, 4, 5, 2, 3, 0, 1});
  size_t shared = 0;
  forest.forEachShared(8, [&](const Forest::Place&, const Forest::Place&) { ++shared; });
  EXPECT_EQ(forest.raster().samples() - shared, size_t{2} << 6);
}

TEST(Solids, NeighboursOfNodesShareTheMiddleOfASideInSpace) {
  constexpr uint32_t kDepth = 4;
  for (const Solid& solid : solids()) {
    const ForestAdjacency adjacency(Forest(kDepth, sidesOf(solid)));
    for (uint32_t level = 0; level < kDepth; ++level) {
      std::map<Key, std::vector<std::pair<ForestNode, uint32_t>>> sides;
      forEachNode(adjacency.patches(), level, [&](const ForestNode& node) {
        for (uint32_t side = 0; side < 4; ++side)
          sides[middleOf(solid, node, side)].emplace_back(node, side);
      });
      for (const auto& [middle, both] : sides) {
        ASSERT_EQ(both.size(), 2u) << solid.name;
        for (const size_t i : {0u, 1u}) {
          const auto& [node, side] = both[i];
          ForestTraversal at(adjacency, node);
          ASSERT_TRUE(at.step(turned(Heading::kNorth, side)));
          ASSERT_EQ(at.node(), both[1 - i].first) << solid.name;
          ASSERT_EQ(at.code(), adjacency.codeOf(at.node()));
          // Straight on: out over the side that lies across.
          ASSERT_EQ(at.ahead(turned(Heading::kNorth, side)),
                    turned(Heading::kNorth, both[1 - i].second + 2));
        }
      }
    }
  }
}

TEST(Solids, SamplesThatPatchesShareAreOnePoint) {
  for (const Solid& solid : solids()) {
    const Forest forest(3, sidesOf(solid));
    const double n = forest.side() - 1;
    const auto at = [&](const Forest::Place& p) {
      return keyOf(
          pointOf(solid, p.patch, static_cast<double>(p.x) / n, static_cast<double>(p.y) / n));
    };
    size_t shared = 0;
    std::map<Key, int> points;
    for (uint32_t patch = 0; patch < forest.patches(); ++patch)
      for (int64_t y = 0; y < forest.side(); ++y)
        for (int64_t x = 0; x < forest.side(); ++x) ++points[at({patch, x, y})];
    forest.forEachShared(8, [&](const Forest::Place& sample, const Forest::Place& owner) {
      ASSERT_EQ(at(sample), at(owner)) << solid.name;
      ++shared;
    });
    EXPECT_EQ(points.size(), (size_t{forest.patches()} << 6) + 2) << solid.name;
    EXPECT_EQ(points.size() + shared, forest.raster().samples()) << solid.name;
  }
}

TEST(Solids, LayoutsTurnAsFewPairsAsTheThesisSays) {
  EXPECT_EQ(turnedPairs(sidesOf(tetrakisHexahedron())), 6u);
  const Layouts cube = layoutsOf(tetrakisHexahedron());
  EXPECT_EQ(cube.count, 4096u);
  EXPECT_EQ(cube.least_turned, 6u);
  EXPECT_EQ(cube.least_border_trees, 0u);
  EXPECT_EQ(cube.turned_without_trees, 6u);
  EXPECT_TRUE(Forest::isSound(cube.sides));
  EXPECT_EQ(turnedPairs(cube.sides), 6u);
  EXPECT_EQ(layoutsOf(octahedron()).count, 16u);
  EXPECT_EQ(layoutsOf(octahedron()).least_border_trees, 0u);
  EXPECT_EQ(layoutsOf(icosahedron()).count, 1024u);
}

}  // namespace
}  // namespace tetrakis::bench
