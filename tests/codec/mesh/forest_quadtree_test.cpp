// SPDX-License-Identifier: Apache-2.0
// Quadtrees of forests (thesis 4.6), by brute force over the samples that patches share: what two
// nodes have in common tells that they are neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/forest.hpp"
#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/study/forest_quadtree.hpp"
#include "codec/mesh/study/forest_traversal.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

constexpr Heading kHeadings[] = {Heading::kNorth, Heading::kEast, Heading::kSouth, Heading::kWest};

template <class Check>
void forEachForest(int deepest, const Check& check) {
  for (const ForestShape& shape : forestShapes()) {
    for (int depth = 1; depth <= deepest; ++depth) {
      SCOPED_TRACE(shape.name + ", depth " + std::to_string(depth));
      check(shape, Forest(depth, shape.sides));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

template <class Visit>
void forEachNode(const Forest& forest, uint32_t level, const Visit& visit) {
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (uint32_t row = 0; row < 1u << level; ++row)
      for (uint32_t column = 0; column < 1u << level; ++column)
        visit(ForestNode{patch, {level, column, row}});
}

template <class Visit>
void forEachNode(const Forest& forest, const Visit& visit) {
  for (uint32_t level = 0; level < static_cast<uint32_t>(forest.depth()); ++level)
    forEachNode(forest, level, visit);
}

/// A sample of a patch that has two for each node of a level, as the surface has it.
using Sample = std::tuple<uint32_t, int64_t, int64_t>;

Sample sampleAt(const Forest& forest, const ForestNode& node, int64_t x, int64_t y) {
  const auto [level, column, row] = node.square;
  const auto [patch, at_x, at_y] =
      forest.owner(int64_t{2} << level, {node.patch, 2 * column + x, 2 * row + y});
  return {patch, at_x, at_y};
}

Sample middleOf(const Forest& forest, const ForestNode& node, Heading side) {
  constexpr int64_t kX[] = {1, 2, 1, 0}, kY[] = {0, 1, 2, 1};
  const auto s = static_cast<size_t>(side);
  return sampleAt(forest, node, kX[s], kY[s]);
}

struct NodeSide {
  ForestNode node;
  Heading side;
  bool operator==(const NodeSide&) const = default;
};

/// The sides of nodes of a level by the sample in their middle: two, or one at a border.
std::map<Sample, std::vector<NodeSide>> sidesOf(const Forest& forest, uint32_t level) {
  std::map<Sample, std::vector<NodeSide>> sides;
  forEachNode(forest, level, [&](const ForestNode& node) {
    for (const Heading side : kHeadings)
      sides[middleOf(forest, node, side)].push_back({node, side});
  });
  return sides;
}

void expectAt(const ForestTraversal& at, const ForestAdjacency& adjacency, const ForestNode& node) {
  ASSERT_EQ(at.node(), node);
  ASSERT_EQ(at.code(), adjacency.codeOf(node));
  ASSERT_EQ(at.local(), QuadtreeShape{adjacency.depth()}.nodeOf(node.square));
}

TEST(ForestCodes, AreARangeWithoutGaps) {
  forEachForest(4, [](const ForestShape& shape, const Forest& forest) {
    const ForestAdjacency adjacency(forest);
    std::set<uint32_t> codes;
    forEachNode(forest, [&](const ForestNode& node) {
      const uint32_t code = adjacency.codeOf(node);
      codes.insert(code);
      ASSERT_EQ(adjacency.nodeOf(code), node);
    });
    const size_t nodes = shape.patches() * ((size_t{1} << 2 * forest.depth()) - 1) / 3;
    ASSERT_EQ(codes.size(), nodes);
    ASSERT_EQ(*codes.rbegin(), nodes - 1);
  });
}

TEST(ForestTraversal, NeighboursShareTheSideBetweenThem) {
  forEachForest(4, [](const ForestShape&, const Forest& forest) {
    const ForestAdjacency adjacency(forest);
    for (uint32_t level = 0; level < adjacency.depth(); ++level) {
      for (const auto& [middle, sides] : sidesOf(forest, level)) {
        ASSERT_LE(sides.size(), 2u);
        for (const NodeSide& from : sides) {
          ForestTraversal at(adjacency, from.node);
          ASSERT_EQ(at.step(from.side), sides.size() == 2);
          const NodeSide& to = sides.size() == 2 && sides[0] == from ? sides[1] : sides[0];
          expectAt(at, adjacency, to.node);
          if (sides.size() == 1) continue;
          ASSERT_EQ(at.ahead(from.side), turned(to.side, 2));
          // The way back is the opposite one, and turns headings back.
          ASSERT_TRUE(at.step(turned(from.side, 2)));
          expectAt(at, adjacency, from.node);
          ASSERT_EQ(at.ahead(from.side), from.side);
        }
      }
    }
  });
}

TEST(ForestTraversal, TurnsRoundACornerLeadThroughAllOfItsNodes) {
  forEachForest(4, [](const ForestShape&, const Forest& forest) {
    const ForestAdjacency adjacency(forest);
    for (uint32_t level = 0; level < adjacency.depth(); ++level) {
      std::map<Sample, size_t> corners;  // how many nodes have them
      forEachNode(forest, level, [&](const ForestNode& node) {
        for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 2}, {0, 2}})
          ++corners[sampleAt(forest, node, x, y)];
      });
      forEachNode(forest, level, [&](const ForestNode& node) {
        // Round its north-western corner: north, west, south, east in what was north at first.
        ForestTraversal at(adjacency, node);
        const size_t nodes = corners[sampleAt(forest, node, 0, 0)];
        size_t steps = 0;
        bool open = false;
        for (; steps < nodes && !open; ++steps)
          open = !at.step(turned(Heading::kNorth, static_cast<uint32_t>(3 * steps)));
        ASSERT_TRUE(open || at.node() == node) << nodes;
      });
    }
  });
}

TEST(ForestTraversal, StraightPathsCloseRoundTheCubeAndTheOctahedron) {
  for (const ForestShape& shape : {cubeShape(), octahedronShape()}) {
    const Forest forest(4, shape.sides);
    const ForestAdjacency adjacency(forest);
    forEachNode(forest, [&](const ForestNode& node) {
      for (const Heading heading : kHeadings) {
        ForestTraversal at(adjacency, node);
        for (uint32_t step = 0; step < 4u << node.square.level; ++step)
          ASSERT_TRUE(at.step(heading));
        ASSERT_EQ(at.node(), node) << shape.name;
        ASSERT_EQ(at.ahead(heading), heading) << shape.name;
      }
    });
  }
}

TEST(ForestTraversal, PathsOfStepsAndChildrenKeepTheirCodes) {
  forEachForest(4, [](const ForestShape&, const Forest& forest) {
    const ForestAdjacency adjacency(forest);
    std::mt19937 random(11);
    for (int path = 0; path < 50; ++path) {
      ForestTraversal at(adjacency, {static_cast<uint32_t>(random() % forest.patches()), {}});
      for (uint32_t level = 1; level < adjacency.depth(); ++level) {
        at.toChild(static_cast<uint32_t>(random() % 4));
        for (int step = 0; step < 40; ++step) at.step(kHeadings[random() % 4]);
        expectAt(at, adjacency, adjacency.nodeOf(at.code()));
      }
    }
  });
}

TEST(ForestQuadtree, EveryVertexOfTheSurfaceHasOnePlace) {
  forEachForest(4, [](const ForestShape& shape, const Forest& forest) {
    const ForestAdjacency adjacency(forest);
    std::map<Sample, ForestPlace> places;  // by level, too: samples of levels differ in size
    std::set<std::tuple<uint32_t, uint64_t>> used;
    size_t vertices = 0;
    for (uint32_t level = 0; level < adjacency.depth(); ++level) {
      places.clear();
      const auto add = [&](const Sample& sample, const ForestPlace& place) {
        const auto [known, is_new] = places.try_emplace(sample, place);
        ASSERT_EQ(known->second, place);
        if (!is_new) return;
        ++vertices;
        used.insert({place.patch, place.place.order()});
      };
      forEachNode(forest, level, [&](const ForestNode& node) {
        add(sampleAt(forest, node, 1, 1), centreOf(adjacency, node));
        for (const Heading side : kHeadings)
          add(middleOf(forest, node, side), midpointOf(adjacency, node, side));
      });
    }
    ASSERT_EQ(used.size(), vertices);
    std::set<Sample> corners;
    forEachNode(forest, 0, [&](const ForestNode& patch) {
      for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 2}, {0, 2}})
        corners.insert(sampleAt(forest, patch, x, y));
    });
    // P 4^d + χ of closed forests.
    ASSERT_EQ(vertices + corners.size(), shape.samples(forest.depth()));
  });
}

TEST(ForestQuadtree, NeedsBorderTreesOnlyWhereEastAndSouthMeet) {
  const auto trees = [](const ForestShape& shape) {
    return borderTrees(ForestAdjacency(Forest(2, shape.sides)));
  };
  EXPECT_EQ(trees(octahedronShape()), 0u);
  EXPECT_EQ(trees(torusShape()), 0u);
  EXPECT_EQ(trees(cubeShape()), 2u);
  EXPECT_EQ(trees(planeShape(1, 1)), 2u);
  EXPECT_EQ(trees(planeShape(2, 3)), 5u);
}

/// A mesh of a forest, in a quadtree; heights tell its samples apart.
struct StoredMesh {
  explicit StoredMesh(const Forest& forest, uint32_t seed)
      : lattice(forest), heights(forest.raster().samples()), in(heights.size()) {
    for (size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i);
    shareOwned(forest, std::span(heights), forest.side() - 1);
    std::mt19937 random(seed);
    std::vector<uint8_t> marks(heights.size());
    for (uint8_t& mark : marks) mark = random() % (4 + seed * 20) == 0;
    vertices = closureOfMarks(lattice, marks);
    for (const ForestVertex v : vertices) in[lattice.sample(v)] = 1;
  }

  ForestLattice lattice;
  std::vector<float> heights;
  std::vector<uint8_t> in;
  std::vector<ForestVertex> vertices;
};

/// The place of a sample in the raster, where 2^(level + 1) steps are a side.
size_t rasterOf(const Forest& forest, uint32_t level, const Sample& sample) {
  const auto& [patch, x, y] = sample;
  const int64_t step = int64_t{forest.side() - 1} >> (level + 1), side = forest.side();
  return static_cast<size_t>((patch * side + y * step) * side + x * step);
}

TEST(ForestQuadtree, HoldsTheVerticesOfAMeshAndTheirHeights) {
  forEachForest(4, [](const ForestShape&, const Forest& forest) {
    for (uint32_t seed = 0; seed < 3; ++seed) {
      const StoredMesh mesh(forest, seed);
      const ForestQuadtree tree(mesh.lattice, mesh.vertices, mesh.heights);
      ASSERT_EQ(tree.vertexCount(), mesh.vertices.size());
      forEachNode(forest, [&](const ForestNode& node) {
        const auto expect = [&](const Sample& sample, const ForestPlace& place) {
          const size_t at = rasterOf(forest, node.square.level, sample);
          const std::optional<float> found = tree.find(place);
          ASSERT_EQ(found.has_value(), mesh.in[at] != 0);
          ASSERT_EQ(found.value_or(mesh.heights[at]), mesh.heights[at]);
        };
        expect(sampleAt(forest, node, 1, 1), centreOf(tree.adjacency(), node));
        for (const Heading side : kHeadings)
          expect(middleOf(forest, node, side), midpointOf(tree.adjacency(), node, side));
      });
    }
  });
}

TEST(ForestQuadtree, LocatesTheDeepestNodeAtAPoint) {
  forEachForest(4, [](const ForestShape&, const Forest& forest) {
    const StoredMesh mesh(forest, 2);
    const ForestQuadtree tree(mesh.lattice, mesh.vertices, mesh.heights);
    const uint32_t depth = tree.adjacency().depth();
    std::mt19937 random(3);
    for (int point = 0; point < 100; ++point) {
      const auto patch = static_cast<uint32_t>(random() % forest.patches());
      const double scale = static_cast<double>(1u << depth);
      const double x = std::uniform_real_distribution(0.0, scale)(random);
      const double y = std::uniform_real_distribution(0.0, scale)(random);
      std::optional<ForestNode> deepest;
      forEachNode(forest, [&](const ForestNode& node) {
        const double size = static_cast<double>(1u << (depth - node.square.level));
        const double west = node.square.column * size, north = node.square.row * size;
        const bool inside = west <= x && x < west + size && north <= y && y < north + size;
        if (node.patch == patch && inside && tree.has(node)) deepest = node;
      });
      ASSERT_EQ(tree.locate(patch, x, y), deepest);
    }
  });
}

}  // namespace
}  // namespace tetrakis::test
