// SPDX-License-Identifier: Apache-2.0
// 4-8 meshes of forests by brute force: all closed sets of small forests, and the errors of meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "base/forest.hpp"
#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

const std::vector<ForestShape> kShapes = {octahedronShape(), torusShape(), planeShape(2, 2),
                                          planeShape(1, 1)};

/// Heights of a forest without order, equal where patches share a sample.
std::vector<int32_t> roughHeights(const Forest& forest) {
  std::vector<int32_t> heights(forest.raster().samples());
  uint32_t state = 7;
  for (int32_t& h : heights) {
    state = state * 1664525 + 1013904223;
    h = static_cast<int32_t>(state >> 24);
  }
  shareOwned(forest, std::span(heights), forest.side() - 1);
  return heights;
}

/// Calls visit(set) for closed sets, at most so many of them. A set has a mark for each vertex.
void forEachClosedSet(const ClosureGraph& graph, size_t most,
                      const std::function<void(const std::vector<uint8_t>&)>& visit) {
  std::vector<uint8_t> in(graph.parents.size());
  size_t count = 0;
  const std::function<void(size_t)> choose = [&](size_t v) {
    if (count == most) return;
    if (v == in.size()) {
      ++count;
      return visit(in);
    }
    const auto has = [&](uint32_t p) { return p == ClosureFlow::kNone || in[p] != 0; };
    choose(v + 1);
    if (!std::all_of(graph.parents[v].begin(), graph.parents[v].end(), has)) return;
    in[v] = 1;
    choose(v + 1);
    in[v] = 0;
  };
  choose(0);
}

std::vector<ForestVertex> numbersOf(const std::vector<uint8_t>& set) {
  std::vector<ForestVertex> vertices;
  for (size_t v = 0; v < set.size(); ++v)
    if (set[v] != 0) vertices.push_back(static_cast<ForestVertex>(v));
  return vertices;
}

/// The edges that have as many triangles on one side as on the other are closed. Those of a vertex
/// with itself have none.
size_t openEdges(const LatticeMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh.triangles[t + k], b = mesh.triangles[t + (k + 1) % 3];
      if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  size_t open = 0;
  for (const auto& [edge, sum] : balance) open += sum != 0;
  return open;
}

/// The squared error of a mesh with these heights at its vertices, every sample of the surface
/// once. weights: of the samples of a patch.
template <class Height>
double squaredError(const ForestLattice& lattice, const std::vector<int32_t>& samples,
                    const std::vector<Height>& heights, const std::vector<uint8_t>& set,
                    const std::vector<float>& weights = {}) {
  const Forest& forest = lattice.forest();
  const uint32_t side = forest.side(), n = side - 1;
  std::vector<uint8_t> seen(samples.size());
  double squares = 0;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    std::vector<VertexId> local;
    for (VertexId v = 0; v < lattice.patch().vertexCount(); ++v)
      if (set[lattice.vertex(patch, v)] != 0) local.push_back(v);
    const LatticeMesh mesh = meshOf(lattice.patch(), local);
    const size_t first = size_t{patch} * side * side;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      std::array<uint32_t, 3> corner;
      std::array<GridPoint, 3> at;
      for (size_t k = 0; k < 3; ++k) {
        corner[k] = mesh.vertices[mesh.triangles[t + k]];
        at[k] = {corner[k] % side, corner[k] / side};
      }
      const TriangleSamples inside(at);
      inside.forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
        const Forest::Place owner = forest.owner(n, {patch, x, y});
        const size_t place = (owner.patch * size_t{side} + static_cast<size_t>(owner.y)) * side +
                             static_cast<size_t>(owner.x);
        if (seen[place]++ != 0) return;
        double plane = 0;
        for (size_t k = 0; k < 3; ++k)
          plane += static_cast<double>(e[k]) * static_cast<double>(heights[first + corner[k]]);
        const double error =
            plane / static_cast<double>(inside.doubledArea()) - samples[first + y * side + x];
        squares += error * error * (weights.empty() ? 1.0f : weights[y * side + x]);
      });
    }
  }
  return squares;
}

uint32_t triangles(const ForestLattice& lattice, const ClosureGraph& graph,
                   const std::vector<uint8_t>& set) {
  uint32_t count = lattice.baseTriangles();
  for (size_t v = 0; v < set.size(); ++v) count += set[v] != 0 ? graph.costs[v] : 0u;
  return count;
}

TEST(ForestMesh, HasAsManySamplesAsTheSurface) {
  for (const ForestShape& shape : kShapes) {
    for (int depth = 1; depth <= 4; ++depth) {
      const Forest forest(depth, shape.sides);
      const std::vector<uint8_t> owned = ownedSamples(forest).bytes();
      const auto samples =
          static_cast<uint32_t>(std::count(owned.begin(), owned.end(), uint8_t{1}));
      EXPECT_EQ(samples, shape.samples(depth)) << shape.name;
      const ForestLattice lattice(forest);
      std::vector<uint32_t> of_corners;
      for (const uint32_t v : meshOf(lattice, {}).vertices) of_corners.push_back(v);
      EXPECT_EQ(samples, lattice.vertexCount() + of_corners.size()) << shape.name;
    }
  }
}

TEST(ForestMesh, EveryClosedSetOfASmallForestConforms) {
  constexpr size_t kMost = 20000;
  for (const ForestShape& shape : kShapes) {
    const bool closed = std::count(shape.sides.begin(), shape.sides.end(), Forest::kBorder) == 0;
    for (int depth = 1; depth <= 2; ++depth) {
      const Forest forest(depth, shape.sides);
      const ForestLattice lattice(forest);
      const ClosureGraph graph = lattice.graph();
      forEachClosedSet(graph, kMost, [&](const std::vector<uint8_t>& set) {
        const LatticeMesh mesh = meshOf(lattice, numbersOf(set));
        ASSERT_EQ(mesh.triangleCount(), triangles(lattice, graph, set)) << shape.name;
        if (!closed) return;
        ASSERT_EQ(openEdges(mesh), 0u) << shape.name;
      });
    }
  }
}

TEST(ForestMesh, ErrorsAreTheSumsOfTheGainsThatAreLeftOut) {
  for (const ForestShape& shape : kShapes) {
    for (int depth = 1; depth <= 2; ++depth) {
      const Forest forest(depth, shape.sides);
      const ForestLattice lattice(forest);
      const std::vector<int32_t> heights = roughHeights(forest);
      const std::vector<double> gains = forestGains(lattice, heights);
      forEachClosedSet(lattice.graph(), 300, [&](const std::vector<uint8_t>& set) {
        double left_out = 0;
        for (size_t v = 0; v < set.size(); ++v) left_out += set[v] == 0 ? gains[v] : 0;
        ASSERT_NEAR(left_out, squaredError(lattice, heights, heights, set), 1e-6 * left_out + 1e-3)
            << shape.name << ", depth " << depth;
      });
    }
  }
}

/// Symmetric weights, so that samples that patches share have one.
std::vector<float> roundWeights(uint32_t side) {
  std::vector<float> weights;
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x)
      weights.push_back(1 /
                        (1 + 0.01f * static_cast<float>(x * (side - 1 - x) + y * (side - 1 - y))));
  return weights;
}

/// No other heights of a vertex, within the range of all samples, leave a smaller error.
TEST(ForestMesh, FittedHeightsLeaveTheLeastError) {
  std::vector<ForestShape> all = kShapes;
  all.push_back(cubeShape());
  all.push_back(coneShape());
  for (const ForestShape& shape : all) {
    const Forest forest(3, shape.sides);
    const ForestLattice lattice(forest);
    const std::vector<int32_t> heights = roughHeights(forest);
    const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
    for (const std::vector<float>& weights : {std::vector<float>(), roundWeights(forest.side())}) {
      const std::vector<ForestVertex> vertices =
          forestBudgetVertices(lattice, heights, 20 * forest.patches(), weights);
      std::vector<uint8_t> set(lattice.vertexCount());
      for (const ForestVertex v : vertices) set[v] = 1;
      const std::vector<double> fitted = fittedHeights(lattice, heights, {}, vertices, weights);
      const auto error = [&](const std::vector<double>& of) {
        return squaredError(lattice, heights, of, set, weights);
      };
      const double smallest = error(fitted);
      EXPECT_LT(smallest, 0.95 * squaredError(lattice, heights, heights, set, weights))
          << shape.name;
      for (size_t i = 0; i < vertices.size(); i += 3) {
        for (const double by : {-3.0, 3.0}) {
          std::vector<double> moved = fitted;
          double& height = moved[lattice.sample(vertices[i])];
          height += by;
          if (height < *least || height > *most) continue;
          shareOwned(forest, std::span(moved), forest.side() - 1);
          EXPECT_GE(error(moved), smallest) << shape.name;
        }
      }
    }
  }
}

/// Where a sample counts more, the mesh comes nearer to it.
TEST(ForestMesh, GainsCountWhatSamplesWeigh) {
  const Forest forest(3, cubeShape().sides);
  const ForestLattice lattice(forest);
  const std::vector<int32_t> heights = roughHeights(forest);
  const std::vector<float> weights = roundWeights(forest.side());
  const std::vector<double> gains = forestGains(lattice, heights, weights);
  const std::vector<uint8_t> none(lattice.vertexCount());
  double all = 0;
  for (const double gain : gains) all += gain;
  const double error = squaredError(lattice, heights, heights, none, weights);
  EXPECT_NEAR(all, error, 1e-5 * error);
}

TEST(ForestMesh, NoClosedSetIsBelowTheHullOfTheBestMeshes) {
  for (const ForestShape& shape : kShapes) {
    const Forest forest(1, shape.sides);
    const ForestLattice lattice(forest);
    const ClosureGraph graph = lattice.graph();
    const std::vector<int32_t> heights = roughHeights(forest);
    const std::vector<double> gains = forestGains(lattice, heights);
    const auto worth = [&](const std::vector<uint8_t>& set) {
      double sum = 0;
      for (size_t v = 0; v < set.size(); ++v) sum += set[v] != 0 ? gains[v] : 0;
      return sum;
    };
    std::map<uint32_t, double> best;  // by triangles
    forEachClosedSet(graph, 1 << 20, [&](const std::vector<uint8_t>& set) {
      double& known = best.try_emplace(triangles(lattice, graph, set), -1e300).first->second;
      known = std::max(known, worth(set));
    });
    size_t corners = 0;
    for (const auto& [count, most] : best) {
      std::vector<uint8_t> set(graph.parents.size());
      for (const ForestVertex v : forestBudgetVertices(lattice, heights, count)) set[v] = 1;
      const uint32_t used = triangles(lattice, graph, set);
      ASSERT_LE(used, count);
      // The line through the set and any larger one lies above no other set between them.
      bool is_corner = true;
      for (const auto& [fewer, a] : best)
        for (const auto& [more, b] : best)
          if (fewer < count && count < more)
            is_corner &= most * (more - fewer) > a * (more - count) + b * (count - fewer);
      if (is_corner && most > 0 && used == count) {
        EXPECT_NEAR(worth(set), most, 1e-6 * most) << shape.name << ", " << count;
        ++corners;
      }
    }
    EXPECT_GT(corners, 0u) << shape.name;
  }
}

}  // namespace
}  // namespace tetrakis::test
