// SPDX-License-Identifier: Apache-2.0
#include "bench/reproduction/forest_walks.hpp"

#include <numeric>
#include <random>
#include <utility>

#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"

namespace tetrakis::bench {

Stored::Stored(const ForestTerrain& terrain, uint32_t divisor)
    : name(terrain.name), mesh(divisor == 1 ? "complete" : "fiftieth") {
  const ForestLattice lattice(terrain.forest);
  std::vector<ForestVertex> vertices(lattice.vertexCount());
  std::iota(vertices.begin(), vertices.end(), 0u);
  const uint32_t triangles = 2u * terrain.forest.patches() << 2 * terrain.forest.depth();
  if (divisor != 1) vertices = forestBudgetVertices(lattice, terrain.heights, triangles / divisor);
  const std::vector<float> heights(terrain.heights.begin(), terrain.heights.end());
  tree = std::make_unique<ForestQuadtree>(lattice, vertices, heights);
  for (uint32_t patch = 0; patch < terrain.forest.patches(); ++patch)
    tree->patch(patch).forEachVertex([&](const QuadtreePlace& place) {
      if (place.tree == QuadtreePlace::kNodes && place.vertex == kCentre)
        nodes.push_back({patch, tree->patch(patch).shape().squareOf(place.level, place.node)});
    });
}

namespace {

template <class Step>
double walkTree(const SemilinearQuadtree& tree, const IndexDifferences& differences,
                const Square& start, uint32_t steps, Step step) {
  Traversal at(differences, start);
  LevelCursor<3> cursor(tree.nodes(start.level));
  double sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    step(at);
    const uint32_t number = cursor.number(at.node(), kCentre);
    if (number != kNoVertex) sum += static_cast<double>(tree.values()[number]);
  }
  return sum;
}

bool leavesPatch(const Start& start) {
  const auto [level, column, row] = start.node.square;
  const uint32_t last = (1u << level) - 1;
  const bool ends[] = {row == 0, column == last, row == last, column == 0};
  return ends[static_cast<size_t>(start.heading)];
}

}  // namespace

double walkForest(const ForestQuadtree& tree, const Start& start, uint32_t steps) {
  ForestTraversal at(tree.adjacency(), start.node);
  uint32_t patch = start.node.patch;
  const uint32_t level = start.node.square.level;
  LevelCursor<3> cursor(tree.patch(patch).nodes(level));
  const float* values = tree.patch(patch).values().data();
  double sum = 0;
  for (uint32_t i = 0; i < steps; ++i) {
    at.step(start.heading);
    if (at.node().patch != patch) {
      patch = at.node().patch;
      cursor = LevelCursor<3>(tree.patch(patch).nodes(level));
      values = tree.patch(patch).values().data();
    }
    const uint32_t number = cursor.number(at.local(), kCentre);
    if (number != kNoVertex) sum += static_cast<double>(values[number]);
  }
  return sum;
}

double walkOneTree(const ForestQuadtree& forest, const Start& start, uint32_t steps) {
  const SemilinearQuadtree& tree = forest.patch(0);
  const IndexDifferences& differences = forest.adjacency().differences();
  const auto walk = [&](auto step) {
    return walkTree(tree, differences, start.node.square, steps, step);
  };
  switch (start.heading) {
    case Heading::kNorth:
      return walk([](Traversal& t) { t.north(); });
    case Heading::kEast:
      return walk([](Traversal& t) { t.east(); });
    case Heading::kSouth:
      return walk([](Traversal& t) { t.south(); });
    case Heading::kWest:
      return walk([](Traversal& t) { t.west(); });
  }
  return 0;
}

std::vector<Walks> makeWalks(const Stored& stored) {
  constexpr uint32_t kRead = 1 << 19, kCrossings = 1 << 17;
  std::mt19937 random(1);
  const auto draw = [&](const std::vector<ForestNode>& nodes) {
    return Start{nodes[random() % nodes.size()],
                 turned(Heading::kNorth, static_cast<uint32_t>(random()))};
  };
  std::vector<Walks> all;
  for (const uint32_t steps : {1, 16, 512}) {
    Walks walks{steps == 1 ? "neighbour" : "path_" + std::to_string(steps), steps, {}};
    while (walks.starts.size() < kRead / steps) walks.starts.push_back(draw(stored.nodes));
    all.push_back(std::move(walks));
  }
  Walks crossings{"crossing", 1, {}};
  std::vector<ForestNode> outer;
  for (const ForestNode& node : stored.nodes)
    for (uint32_t side = 0; side < Forest::kSides; ++side)
      if (leavesPatch({node, turned(Heading::kNorth, side)})) outer.push_back(node);
  while (crossings.starts.size() < kCrossings) {
    const Start start = draw(outer);
    if (leavesPatch(start)) crossings.starts.push_back(start);
  }
  all.push_back(std::move(crossings));
  return all;
}

}  // namespace tetrakis::bench
