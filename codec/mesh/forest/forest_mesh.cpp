// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/forest/forest_mesh.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/surface/surface.hpp"

namespace tetrakis::inline forest {

namespace {

/// Samples for each triangle that are left where fine levels are skipped. More samples choose
/// better meshes, and take time.
constexpr uint64_t kPerTriangle = 20;

/// Samples of a glued side lie in two patches, of which each sees half of their errors.
std::vector<float> sideWeights(const Forest& forest, uint32_t patch) {
  const uint32_t side = forest.side(), n = side - 1;
  std::vector<float> weights(size_t{side} * side, 1.0f);
  const auto halve = [&](uint32_t which, size_t first, size_t step) {
    if (forest.sides()[patch * Forest::kSides + which] == Forest::kBorder) return;
    for (size_t k = 0; k <= n; ++k) weights[first + k * step] = 0.5f;
  };
  halve(0, 0, 1);
  halve(1, n, side);
  halve(2, size_t{n} * side, 1);
  halve(3, 0, side);
  return weights;
}

/// Every 2^k-th sample of each patch of a raster.
std::vector<int32_t> everyOther(const Forest& forest, std::span<const int32_t> raster, int k) {
  const uint32_t step = 1u << k, side = forest.side();
  std::vector<int32_t> coarse;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch)
    for (uint32_t y = 0; y < side; y += step)
      for (uint32_t x = 0; x < side; x += step)
        coarse.push_back(raster[(size_t{patch} * side + y) * side + x]);
  return coarse;
}

/// The finest levels that can be left out.
int spareLevels(const Forest& forest, uint32_t max_triangles) {
  int k = 0;
  while (k + 1 < forest.depth() &&
         forest.raster().samples() >> (2 * (k + 1)) >= kPerTriangle * max_triangles)
    ++k;
  return k;
}

/// Vertices of the best set, and as many coarse ones of the next corner as fit.
std::vector<ForestVertex> withinBudget(const ForestLattice& lattice, const ClosureGraph& graph,
                                       std::span<const double> gains, uint32_t max_triangles) {
  const int64_t room = int64_t{max_triangles} - lattice.baseTriangles();
  const std::vector<double> sides = hullSides(graph, gains, room);
  std::vector<uint8_t> in(sides.size());
  int64_t left = room;
  for (size_t v = 0; v < sides.size(); ++v) {
    in[v] = sides[v] == hull_side::kWithin;
    if (in[v] != 0) left -= graph.costs[v];
  }
  const auto mayFollow = [&](size_t v) {
    const ClosureFlow::Arcs& parents = graph.parents[v];
    return std::all_of(parents.begin(), parents.end(), [&](uint32_t parent) {
      return parent == ClosureFlow::kNone || in[parent] != 0;
    });
  };
  for (size_t v = 0; v < sides.size(); ++v) {
    if (sides[v] != hull_side::kAcross || graph.costs[v] > left || !mayFollow(v)) continue;
    in[v] = 1;
    left -= graph.costs[v];
  }
  std::vector<ForestVertex> vertices;
  for (size_t v = 0; v < sides.size(); ++v)
    if (in[v] != 0) vertices.push_back(static_cast<ForestVertex>(v));
  return vertices;
}

}  // namespace

std::vector<double> forestGains(const ForestLattice& lattice, Coordinates coordinates) {
  const Forest& forest = lattice.forest();
  const uint32_t side = forest.side();
  const size_t samples = size_t{side} * side;
  std::vector<double> gains(lattice.vertexCount());
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const std::vector<float> weights = sideWeights(forest, patch);
    for (const std::span<const int32_t> raster : coordinates) {
      const std::vector<double> own = vertexGains(
          lattice.patch(), {side, side, raster.subspan(patch * samples, samples), weights});
      for (VertexId v = 0; v < own.size(); ++v) gains[lattice.vertex(patch, v)] += own[v];
    }
  }
  return gains;
}

std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                               Coordinates coordinates, uint32_t max_triangles) {
  if (max_triangles <= lattice.baseTriangles()) return {};
  const Forest& forest = lattice.forest();
  const int skipped = spareLevels(forest, max_triangles);
  if (skipped == 0)
    return withinBudget(lattice, lattice.graph(), forestGains(lattice, coordinates), max_triangles);
  const Forest coarse_forest(forest.depth() - skipped, forest.sides());
  const ForestLattice coarse(coarse_forest);
  std::vector<std::vector<int32_t>> every_other;
  for (const std::span<const int32_t> raster : coordinates)
    every_other.push_back(everyOther(forest, raster, skipped));
  const std::vector<std::span<const int32_t>> spans(every_other.begin(), every_other.end());
  const std::vector<double> gains = forestGains(coarse, spans);
  // Coarse levels come first, in the same order.
  return withinBudget(coarse, coarse.graph(), gains, max_triangles);
}

uint64_t forestMeshBytes(const Forest& forest) {
  constexpr uint64_t kLattice = 12, kGraph = 9, kGains = 24, kFlow = 72, kMesh = 40, kMoments = 160;
  return forest.raster().samples() * (kLattice + kGraph + kGains + kFlow + kMesh) +
         kMoments * forest.side() * uint64_t{forest.side()};
}

}  // namespace tetrakis::inline forest
