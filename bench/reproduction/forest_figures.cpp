// SPDX-License-Identifier: Apache-2.0
#include "bench/reproduction/forest_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <set>
#include <utility>

#include "bench/reproduction/forest_terrain.hpp"
#include "bench/reproduction/solids.hpp"
#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/study/forest_quadtree.hpp"

namespace tetrakis::bench {

namespace {

constexpr int kMostCounted = 6;       // depth
constexpr int kFlat = 2, kRound = 3;  // depths of complete meshes that are drawn
constexpr int kRelief = 7;            // of the terrain
constexpr uint32_t kReliefTriangles = 1600;
constexpr double kReliefHeight = 0.25;  // of radii

std::vector<Solid> allSolids() {
  return {tetrahedron(), octahedron(), icosahedron(), tetrakisHexahedron()};
}

std::vector<ForestVertex> allVertices(const ForestLattice& lattice) {
  std::vector<ForestVertex> all(lattice.vertexCount());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// Vertices less edges and more triangles.
double eulerOf(const LatticeMesh& mesh) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (size_t k = 0; k < 3; ++k)
      edges.insert(std::minmax(mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]));
  return static_cast<double>(mesh.vertices.size()) - static_cast<double>(edges.size()) +
         static_cast<double>(mesh.triangleCount());
}

void countSizes(const Solid& solid, std::vector<ResultRow>& rows) {
  for (int depth = 1; depth <= kMostCounted; ++depth) {
    const Forest forest(depth, sidesOf(solid));
    const ForestLattice lattice(forest);
    const LatticeMesh mesh = meshOf(lattice, allVertices(lattice));
    const std::string of = "depth_" + std::to_string(depth);
    rows.push_back({solid.name, of, "vertices", static_cast<double>(mesh.vertices.size())});
    rows.push_back({solid.name, of, "triangles", static_cast<double>(mesh.triangleCount())});
    rows.push_back({solid.name, of, "euler", eulerOf(mesh)});
    const double interior = std::ldexp(forest.patches(), 2 * depth);
    rows.push_back(
        {solid.name, of, "vertices_beyond", static_cast<double>(mesh.vertices.size()) - interior});
  }
}

}  // namespace

void countSolids(std::vector<ResultRow>& rows) {
  std::printf("%-20s %8s %6s %8s %6s %6s\n", "solid", "layouts", "turned", "trees", "least",
              "least");
  for (const Solid& solid : allSolids()) {
    countSizes(solid, rows);
    const std::vector<uint32_t> sides = sidesOf(solid);
    const Layouts layouts = layoutsOf(solid);
    const uint32_t turned = turnedPairs(sides);
    const uint32_t trees = borderTrees(ForestAdjacency(Forest(1, sides)));
    std::printf("%-20s %8llu %6u %8u %6u %6u\n", solid.name.c_str(),
                static_cast<unsigned long long>(layouts.count), turned, trees, layouts.least_turned,
                layouts.least_border_trees);
    const auto add = [&](const std::string& quantity, uint64_t value) {
      rows.push_back({solid.name, "layout", quantity, static_cast<double>(value)});
    };
    add("patches", solid.patches.size());
    add("layouts", layouts.count);
    add("turned", turned);
    add("border_trees", trees);
    add("least_turned", layouts.least_turned);
    add("least_border_trees", layouts.least_border_trees);
    add("turned_without_trees", layouts.turned_without_trees);
    for (size_t side = 0; side < sides.size(); ++side) {
      rows.push_back({solid.name, "sides", "side_" + std::to_string(side), sides[side] * 1.0});
      rows.push_back({solid.name, "sides_without_trees", "side_" + std::to_string(side),
                      layouts.sides[side] * 1.0});
    }
  }
}

void listStored(std::vector<ResultRow>& rows) {
  constexpr uint32_t kDepth = 2;
  const ForestAdjacency adjacency(Forest(kDepth, sidesOf(octahedron())));
  const auto add = [&](uint32_t patch, uint32_t x, uint32_t y, bool is_stored) {
    rows.push_back({"stored",
                    std::to_string(patch) + "_" + std::to_string(x) + "_" + std::to_string(y),
                    "here", is_stored ? 1.0 : 0.0});
  };
  constexpr uint32_t kX[] = {1, 2, 1, 0}, kY[] = {0, 1, 2, 1};
  std::set<std::pair<uint32_t, uint32_t>> seen;  // patch and sample
  for (uint32_t code = 0; code < adjacency.codes().firstOf(kDepth); ++code) {
    const ForestNode node = adjacency.nodeOf(code);
    const uint32_t half = 1u << (kDepth - node.square.level - 1);
    const uint32_t west = 2 * half * node.square.column, north = 2 * half * node.square.row;
    add(node.patch, west + half, north + half, true);
    for (uint32_t side = 0; side < 4; ++side) {
      const uint32_t x = west + half * kX[side], y = north + half * kY[side];
      if (!seen.insert({node.patch, y << 16 | x}).second) continue;
      const Heading heading = turned(Heading::kNorth, side);
      add(node.patch, x, y, midpointOf(adjacency, node, heading).patch == node.patch);
    }
  }
}

namespace {

/// Every node of a path, and the difference of codes from its first to its last one.
void addPath(const std::string& name, const ForestAdjacency& adjacency, const ForestNode& start,
             Heading heading, uint32_t steps, std::vector<ResultRow>& rows) {
  ForestTraversal at(adjacency, start);
  const double first = at.code();
  for (uint32_t step = 0; step <= steps; ++step) {
    const auto add = [&](const char* quantity, uint32_t value) {
      rows.push_back({name, "step_" + std::to_string(step), quantity, value * 1.0});
    };
    add("patch", at.node().patch);
    add("column", at.node().square.column);
    add("row", at.node().square.row);
    add("code", at.code());
    if (step < steps) at.step(heading);
  }
  rows.push_back({name, "all", "difference", at.code() - first});
}

}  // namespace

void listPaths(std::vector<ResultRow>& rows) {
  constexpr int kDepth = 3;
  constexpr uint32_t kLevel = 2;
  const ForestAdjacency grid(torusOf(2, kDepth).forest);
  addPath("grid_1", grid, {0, {kLevel, 3, 1}}, Heading::kEast, 1, rows);
  addPath("grid_2", grid, {3, {kLevel, 1, 0}}, Heading::kNorth, 1, rows);
  addPath("grid_3", grid, {2, {kLevel, 2, 2}}, Heading::kEast, 4, rows);
  addPath("grid_4", grid, {0, {kLevel, 0, 2}}, Heading::kSouth, 3, rows);
  const ForestAdjacency cube(Forest(kDepth, sidesOf(tetrakisHexahedron())));
  addPath("cube_1", cube, {0, {kLevel, 1, 2}}, Heading::kEast, 15, rows);
  addPath("cube_2", cube, {0, {kLevel, 2, 1}}, Heading::kNorth, 15, rows);
  addPath("cube_3", cube, {1, {kLevel, 0, 0}}, Heading::kNorth, 15, rows);
}

namespace {

/// Appends the triangles of a mesh; height(sample) in radii above the sphere.
template <class Place>
void writeTriangles(std::ofstream& file, const std::string& kind, const Forest& forest,
                    const LatticeMesh& mesh, const Place& place) {
  const uint32_t side = forest.side();
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    file << kind << ',' << mesh.vertices[mesh.triangles[t]] / side / side;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t sample = mesh.vertices[mesh.triangles[t + k]];
      const double last = side - 1;
      const Point p =
          place(sample / side / side, sample % side / last, sample / side % side / last, sample);
      file << ',' << p.x << ',' << p.y << ',' << p.z;
    }
    file << '\n';
  }
}

void writeSolid(const Solid& solid, std::ofstream& file) {
  file << "kind,patch,x0,y0,z0,x1,y1,z1,x2,y2,z2\n";
  const auto flat = [&](uint32_t patch, double x, double y, uint32_t) {
    return pointOf(solid, patch, x, y);
  };
  const auto round = [&](uint32_t patch, double x, double y, uint32_t) {
    return onSphere(pointOf(solid, patch, x, y));
  };
  const auto complete = [&](int depth, const std::string& kind, const auto& place) {
    const Forest forest(depth, sidesOf(solid));
    const ForestLattice lattice(forest);
    writeTriangles(file, kind, forest, patchesOf(lattice, allVertices(lattice)), place);
  };
  complete(kFlat, "flat", flat);
  complete(kRound, "sphere", round);
  const ForestTerrain terrain = terrainOn(solid, kRelief);
  const ForestLattice lattice(terrain.forest);
  const auto raised = [&](uint32_t patch, double x, double y, uint32_t sample) {
    const Point p = round(patch, x, y, sample);
    const double k = 1 + kReliefHeight * (terrain.heights[sample] * 2.0 / ForestTerrain::kMost - 1);
    return Point{k * p.x, k * p.y, k * p.z};
  };
  writeTriangles(
      file, "relief", terrain.forest,
      patchesOf(lattice, forestBudgetVertices(lattice, terrain.heights, kReliefTriangles)), raised);
}

}  // namespace

Status writeMeshes(const std::string& folder) {
  for (const Solid& solid : allSolids()) {
    const std::string path = folder + "/solid_" + solid.name + ".csv";
    std::ofstream file(path);
    writeSolid(solid, file);
    if (!file.flush()) return {TKS_IO, "Cannot write '" + path + "'."};
  }
  return {};
}

}  // namespace tetrakis::bench
