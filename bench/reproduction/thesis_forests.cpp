// SPDX-License-Identifier: Apache-2.0
// bench_thesis_forests: sections 3.2.2 and 4.6 of the thesis. Solids as forests of quadtrees, their
// counts and layouts; and table 4.1 on forests whose patches are glued in any way: neighbours and
// paths beside those of one quadtree, medians of processor time of one thread.
#include <cstdio>
#include <ctime>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/results.hpp"
#include "bench/reproduction/forest_figures.hpp"
#include "bench/reproduction/forest_terrain.hpp"
#include "bench/reproduction/forest_walks.hpp"
#include "bench/reproduction/solids.hpp"
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

double processorSeconds(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// One way to walk over a stored mesh, and what it took.
struct Contender {
  std::string name;
  const Stored* stored;
  double (*walk)(const ForestQuadtree& tree, const Start& start, uint32_t steps);
  std::vector<double> figures;
};

/// Alternating runs of all contenders: medians of nanoseconds for each of so many.
template <class Work>
void measureAlike(std::vector<Contender>& contenders, int runs, const Work& work, double count) {
  std::vector<std::vector<double>> times(contenders.size());
  for (int run = 0; run < runs; ++run)
    for (size_t i = 0; i < contenders.size(); ++i)
      times[i].push_back(processorSeconds([&] { work(contenders[i], i); }));
  for (size_t i = 0; i < contenders.size(); ++i)
    contenders[i].figures.push_back(1e9 * median(times[i]) / count);
}

/// A point of a patch.
struct At {
  uint32_t patch;
  double x, y;
};

std::vector<At> makePoints(const ForestAdjacency& adjacency) {
  constexpr size_t kPoints = 1 << 17;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> along(0, 1u << adjacency.depth());
  std::vector<At> points;
  for (size_t i = 0; i < kPoints; ++i)
    points.push_back(
        {static_cast<uint32_t>(random() % adjacency.patches()), along(random), along(random)});
  return points;
}

/// The levels of the nodes at points, in the mean, and the time to find them.
void measurePoints(std::vector<Contender>& contenders, int runs) {
  std::vector<std::vector<At>> points;
  for (const Contender& c : contenders) points.push_back(makePoints(c.stored->tree->adjacency()));
  std::vector<uint64_t> levels(contenders.size());
  const auto count = static_cast<double>(points[0].size());
  measureAlike(
      contenders, runs,
      [&](const Contender& c, size_t i) {
        levels[i] = 0;
        for (const At& at : points[i]) {
          const auto node = c.stored->tree->locate(at.patch, at.x, at.y);
          levels[i] += node ? node->square.level + 1 : 0;
        }
      },
      count);
  for (size_t i = 0; i < contenders.size(); ++i)
    contenders[i].figures.push_back(static_cast<double>(levels[i]) / count);
}

/// All walks, then points. Fails if the first two contenders, which have one mesh, differ.
Status measureAll(std::vector<Contender>& contenders, int runs) {
  std::vector<std::vector<Walks>> walks;
  for (const Contender& c : contenders) walks.push_back(makeWalks(*c.stored));
  for (size_t kind = 0; kind < walks[0].size(); ++kind) {
    std::vector<double> sums(contenders.size());
    const Walks& first = walks[0][kind];
    measureAlike(
        contenders, runs,
        [&](const Contender& c, size_t i) {
          sums[i] = 0;
          for (const Start& start : walks[i][kind].starts)
            sums[i] += c.walk(*c.stored->tree, start, first.steps);
        },
        static_cast<double>(first.starts.size()) * first.steps);
    if (sums[0] != sums[1])
      return {TKS_MISMATCH, "One quadtree and the forest of it read different heights."};
  }
  measurePoints(contenders, runs);
  return {};
}

/// Table 4.1 on forests of meshes of 1 / divisor of all triangles. The first contender has one
/// quadtree, the second the same with its sides glued to each other: what adjacency costs.
Status measureForests(const std::vector<ForestTerrain>& terrains, uint32_t divisor, int runs,
                      std::vector<ResultRow>& rows) {
  std::vector<Stored> stored;
  for (const ForestTerrain& terrain : terrains) stored.emplace_back(terrain, divisor);
  std::vector<Contender> contenders = {{"one tree", &stored[0], walkOneTree, {}}};
  for (const Stored& s : stored) contenders.push_back({s.name, &s, walkForest, {}});
  if (Status status = measureAll(contenders, runs); !status.ok()) return status;
  const char* quantities[] = {
      "neighbour_ns_per_node", "path_16_ns_per_node", "path_512_ns_per_node",
      "crossing_ns_per_node",  "locate_ns",           "located_levels"};
  for (const Contender& c : contenders) {
    const ForestQuadtree& tree = *c.stored->tree;
    const double bytes = static_cast<double>(tree.bytes()) / tree.vertexCount();
    std::printf("%-20s %-9s %9zu", c.name.c_str(), c.stored->mesh.c_str(), c.stored->nodes.size());
    const auto nodes = static_cast<double>(c.stored->nodes.size());
    rows.push_back({c.name, c.stored->mesh, "nodes", nodes});
    rows.push_back({c.name, c.stored->mesh, "bytes_per_vertex", bytes});
    for (size_t i = 0; i < c.figures.size(); ++i) {
      std::printf(" %9.1f", c.figures[i]);
      rows.push_back({c.name, c.stored->mesh, quantities[i], c.figures[i]});
    }
    std::printf(" %9.2f\n", bytes);
  }
  return {};
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  countSolids(rows);
  listStored(rows);
  listPaths(rows);
  if (!options.meshes.empty())
    if (Status status = writeMeshes(options.meshes); !status.ok()) return status;
  std::printf("%-20s %-9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "forest (ns a node)", "mesh", "nodes",
              "neighbour", "path_16", "path_512", "crossing", "locate", "levels", "bytes");
  const auto depth = static_cast<int>(options.depth);
  const std::vector<ForestTerrain> terrains = {torusOf(1, depth),
                                               torusOf(2, depth - 1),
                                               torusOf(4, depth - 2),
                                               straightPair(depth - 1),
                                               terrainOn(octahedron(), depth - 1),
                                               terrainOn(tetrakisHexahedron(), depth - 1),
                                               terrainOn(icosahedron(), depth - 2)};
  for (const uint32_t divisor : {1u, 50u})
    if (Status status = measureForests(terrains, divisor, options.runs, rows); !status.ok())
      return status;
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
