// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/forest/forest_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "base/view.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/surface/surface.hpp"

namespace tetrakis::inline forest {

namespace {

/// Samples for each triangle that are left where fine levels are skipped. More samples choose
/// better meshes, and take time.
constexpr uint64_t kPerTriangle = 20;

std::vector<float> allOf(const Forest& forest, PatchWeights weights) {
  if (weights.empty()) return std::vector<float>(size_t{forest.side()} * forest.side(), 1.0f);
  return {weights.begin(), weights.end()};
}

/// Samples of a glued side lie in two patches, of which each sees half of their errors. all: what
/// samples of a patch weigh.
std::vector<float> sideWeights(const Forest& forest, uint32_t patch,
                               const std::vector<float>& all) {
  const uint32_t side = forest.side(), n = side - 1;
  std::vector<float> weights = all;
  const auto halve = [&](uint32_t which, size_t first, size_t step) {
    if (forest.sides()[patch * Forest::kSides + which] == Forest::kBorder) return;
    for (size_t k = 0; k <= n; ++k) weights[first + k * step] = all[first + k * step] / 2;
  };
  halve(0, 0, 1);
  halve(1, n, side);
  halve(2, size_t{n} * side, 1);
  halve(3, 0, side);
  return weights;
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

std::vector<double> forestGains(const ForestLattice& lattice, Coordinates coordinates,
                                PatchWeights weights) {
  const Forest& forest = lattice.forest();
  const uint32_t side = forest.side();
  const size_t samples = size_t{side} * side;
  const std::vector<float> all = allOf(forest, weights);
  std::vector<double> gains(lattice.vertexCount());
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const std::vector<float> of_patch = sideWeights(forest, patch, all);
    for (const std::span<const int32_t> raster : coordinates) {
      const std::vector<double> own = vertexGains(
          lattice.patch(), {side, side, raster.subspan(patch * samples, samples), of_patch});
      for (VertexId v = 0; v < own.size(); ++v) gains[lattice.vertex(patch, v)] += own[v];
    }
  }
  return gains;
}

int spareLevels(const Forest& forest, uint32_t max_triangles) {
  int k = 0;
  while (k + 1 < forest.depth() &&
         forest.raster().samples() >> (2 * (k + 1)) >= kPerTriangle * max_triangles)
    ++k;
  return k;
}

std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                               Coordinates coordinates, uint32_t max_triangles,
                                               PatchWeights weights) {
  if (max_triangles <= lattice.baseTriangles()) return {};
  const Forest& forest = lattice.forest();
  const int skipped = spareLevels(forest, max_triangles);
  if (skipped == 0)
    return withinBudget(lattice, lattice.graph(), forestGains(lattice, coordinates, weights),
                        max_triangles);
  const Forest coarse_forest(forest.depth() - skipped, forest.sides());
  const ForestLattice coarse(coarse_forest);
  const View every_other{skipped, {}, 0, forest.side()};
  std::vector<std::vector<int32_t>> rasters;
  for (const std::span<const int32_t> raster : coordinates)
    rasters.push_back(slice(raster, forest.raster(), every_other));
  const std::vector<std::span<const int32_t>> spans(rasters.begin(), rasters.end());
  const std::vector<float> of_patch = slice(weights, {forest.side(), forest.side()}, every_other);
  const std::vector<double> gains = forestGains(coarse, spans, of_patch);
  // Coarse levels come first, in the same order.
  return withinBudget(coarse, coarse.graph(), gains, max_triangles);
}

namespace {

/// The sample that is coded for each sample of the raster.
std::vector<uint32_t> ownersOf(const Forest& forest) {
  std::vector<uint32_t> owners(forest.raster().samples());
  std::iota(owners.begin(), owners.end(), 0u);
  shareOwned(forest, std::span(owners), forest.side() - 1);
  return owners;
}

}  // namespace

std::vector<double> fittedHeights(const ForestLattice& lattice, std::span<const int32_t> heights,
                                  std::span<const uint8_t> known,
                                  std::span<const ForestVertex> vertices, PatchWeights weights) {
  const Forest& forest = lattice.forest();
  const uint32_t side = forest.side();
  const size_t samples = size_t{side} * side;
  const std::vector<float> all = allOf(forest, weights);
  const std::vector<uint32_t> owners = ownersOf(forest);
  const PatchVertices of_patches(lattice, vertices);
  std::vector<FittedLeaf> leaves;
  std::vector<float> of_raster;
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    const size_t first = patch * samples;
    const std::vector<float> of_patch = sideWeights(forest, patch, all);
    const WeightedSurface surface{{side, side, heights.subspan(first, samples), of_patch},
                                  known.empty() ? known : known.subspan(first, samples)};
    FittedMoments moments(lattice.patch(), surface);
    moments.coarsen(of_patches.of(patch));
    for (FittedLeaf leaf : moments.leaves()) {
      for (uint32_t& corner : leaf.corners) corner = owners[first + corner];
      leaves.push_back(leaf);
    }
    of_raster.insert(of_raster.end(), all.begin(), all.end());
  }
  const WeightedSurface raster{{side, side * forest.patches(), heights, of_raster}, known};
  std::vector<double> fitted(heights.begin(), heights.end());
  const HeightCorrections moved = fittedCorrections(raster, leaves, fitted);
  for (size_t i = 0; i < moved.samples.size(); ++i)
    fitted[moved.samples[i]] += moved.corrections[i];
  fitted = withinRange(raster, std::move(fitted));
  shareOwned(forest, std::span(fitted), side - 1);
  return fitted;
}

uint64_t forestMeshBytes(const Forest& forest) {
  constexpr uint64_t kLattice = 12, kGraph = 9, kGains = 24, kFlow = 72, kMesh = 40, kMoments = 160;
  return forest.raster().samples() * (kLattice + kGraph + kGains + kFlow + kMesh) +
         kMoments * forest.side() * uint64_t{forest.side()};
}

/// Triangles that are fitted have their moments, and the equations that these make.
uint64_t fittedMeshBytes(const Forest& forest, uint32_t max_triangles) {
  constexpr uint64_t kSample = 48, kTriangle = 400;
  const uint64_t samples = forest.raster().samples();
  const uint64_t triangles = std::clamp<uint64_t>(max_triangles, 2 * forest.patches(), 2 * samples);
  return forestMeshBytes(forest) + kSample * samples + kTriangle * triangles;
}

}  // namespace tetrakis::inline forest
