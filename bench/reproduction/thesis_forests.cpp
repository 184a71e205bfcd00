// SPDX-License-Identifier: Apache-2.0
// bench_thesis_forests: sections 3.2.2 and 4.6 of the thesis. Solids as forests of quadtrees, their
// counts and layouts; and table 4.1 on forests whose patches are glued in any way: neighbours and
// paths beside those of one quadtree, medians of processor time of one thread.
#include <cstdio>
#include <ctime>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bench/harness/arguments.hpp"
#include "bench/harness/median.hpp"
#include "bench/harness/results.hpp"
#include "bench/reproduction/forest_figures.hpp"
#include "bench/reproduction/forest_terrain.hpp"
#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/study/forest_quadtree.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

struct Options {
  uint32_t depth = 10;
  int runs = 5;
  std::string meshes;  // empty: no pictures
  std::string csv;
};

struct Start {
  ForestNode node;
  Heading heading;
};

/// Walks of `steps` nodes each.
struct Walks {
  std::string name;
  uint32_t steps;
  std::vector<Start> starts;
};

/// A mesh of a forest, and the nodes that it has.
struct Stored {
  Stored(const ForestTerrain& terrain, uint32_t divisor);

  std::string name;
  std::string mesh;
  std::unique_ptr<ForestQuadtree> tree;
  std::vector<ForestNode> nodes;
};

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

/// Reads the heights of the next nodes in one direction, over sides of patches.
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

/// The same in one quadtree, which the toroidal differences of theorem 4.1 close.
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

bool leavesPatch(const Start& start) {
  const auto [level, column, row] = start.node.square;
  const uint32_t last = (1u << level) - 1;
  const bool ends[] = {row == 0, column == last, row == last, column == 0};
  return ends[static_cast<size_t>(start.heading)];
}

std::vector<Walks> makeWalks(const Stored& stored) {
  constexpr uint32_t kRead = 1 << 19, kCrossings = 1 << 16;
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

double processorSeconds(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Nanoseconds a node of each kind of walk, and their sums: the same of the same terrain.
template <class Walk>
std::vector<double> measureWalks(const Stored& stored, const std::string& name, const Walk& walk,
                                 int runs, std::vector<ResultRow>& rows) {
  std::vector<double> sums;
  std::printf("%-20s %-9s %9zu", name.c_str(), stored.mesh.c_str(), stored.nodes.size());
  rows.push_back({name, stored.mesh, "nodes", static_cast<double>(stored.nodes.size())});
  for (const Walks& walks : makeWalks(stored)) {
    std::vector<double> times;
    double sum = 0;
    for (int run = 0; run < runs; ++run) {
      sum = 0;
      times.push_back(processorSeconds([&] {
        for (const Start& start : walks.starts) sum += walk(*stored.tree, start, walks.steps);
      }));
    }
    sums.push_back(sum);
    const double nodes = static_cast<double>(walks.starts.size()) * walks.steps;
    const double each = 1e9 * median(times) / nodes;
    std::printf(" %9.1f", each);
    rows.push_back({name, stored.mesh, walks.name + "_ns_per_node", each});
  }
  return sums;
}

/// What a forest stores, and the time to find the node at a point.
void measureStore(const Stored& stored, const std::string& name, int runs,
                  std::vector<ResultRow>& rows) {
  constexpr size_t kPoints = 1 << 17;
  std::mt19937 random(2);
  const ForestQuadtree& tree = *stored.tree;
  std::uniform_real_distribution<double> along(0, 1u << tree.adjacency().depth());
  struct At {
    uint32_t patch;
    double x, y;
  };
  std::vector<At> points;
  for (size_t i = 0; i < kPoints; ++i)
    points.push_back({static_cast<uint32_t>(random() % tree.adjacency().patches()), along(random),
                      along(random)});
  std::vector<double> times;
  uint64_t levels = 0;
  for (int run = 0; run < runs; ++run)
    times.push_back(processorSeconds([&] {
      for (const At& p : points) {
        const auto node = tree.locate(p.patch, p.x, p.y);
        levels += node ? node->square.level + 1 : 0;
      }
    }));
  const double each = 1e9 * median(times) / kPoints;
  const double bytes = static_cast<double>(tree.bytes()) / tree.vertexCount();
  const double mean_level =
      static_cast<double>(levels) / static_cast<double>(kPoints) / static_cast<double>(runs);
  std::printf(" %9.1f %9.2f\n", each, bytes);
  std::fflush(stdout);
  rows.push_back({name, stored.mesh, "locate_ns", each});
  rows.push_back({name, stored.mesh, "located_levels", mean_level});
  rows.push_back({name, stored.mesh, "bytes_per_vertex", bytes});
}

/// One quadtree, and the same with its sides glued to each other: what adjacency costs.
Status measureOneTree(const Stored& stored, int runs, std::vector<ResultRow>& rows) {
  const std::vector<double> alone = measureWalks(stored, "one tree", walkOneTree, runs, rows);
  measureStore(stored, "one tree", runs, rows);
  const std::vector<double> glued = measureWalks(stored, stored.name, walkForest, runs, rows);
  measureStore(stored, stored.name, runs, rows);
  if (alone == glued) return {};
  return {TKS_MISMATCH, "One quadtree and the forest of it read different heights."};
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  countSolids(rows);
  listStored(rows);
  listPaths(rows);
  if (!options.meshes.empty())
    if (Status status = writeMeshes(options.meshes); !status.ok()) return status;
  std::printf("%-20s %-9s %9s %9s %9s %9s %9s %9s %9s\n", "forest (ns a node)", "mesh", "nodes",
              "neighbour", "path_16", "path_512", "crossing", "locate", "bytes");
  const auto depth = static_cast<int>(options.depth);
  for (const uint32_t divisor : {1u, 50u}) {
    if (Status status = measureOneTree({torusOf(1, depth), divisor}, options.runs, rows);
        !status.ok())
      return status;
    const auto measure = [&](const ForestTerrain& terrain) {
      const Stored stored(terrain, divisor);
      measureWalks(stored, stored.name, walkForest, options.runs, rows);
      measureStore(stored, stored.name, options.runs, rows);
    };
    measure(torusOf(2, depth - 1));
    measure(torusOf(4, depth - 2));
    measure(terrainOn(octahedron(), depth - 1));
    measure(terrainOn(tetrakisHexahedron(), depth - 1));
    measure(terrainOn(icosahedron(), depth - 2));
  }
  return updateResults(options.csv, "thesis_forests", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Sections 3.2.2 and 4.6 of the thesis: solids as forests of quadtrees");
  arguments.within({"--depth", "Levels of the quadtree that forests are held against"},
                   options.depth, 5, 12);
  arguments.text({"--meshes", "Folder for the triangles that are drawn"}, options.meshes);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
