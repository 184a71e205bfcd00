// SPDX-License-Identifier: Apache-2.0
// budgetMesh() and screenMesh() choose the vertices of a mesh within a budget of triangles, fit
// their heights and, for a camera, turn edges.
#include "codec/mesh/meshes.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/fitting/fitting.hpp"

namespace tetrakis::inline mesh {

namespace {

/// For each sample how many of those left of it and above it, itself included, differ from the one
/// before them in their row or column.
class Changes {
 public:
  explicit Changes(const SurfaceView& surface)
      : stride_(size_t{surface.width} + 1), sums_(stride_ * (size_t{surface.height} + 1)) {
    const int32_t* here = surface.heights.data();
    for (uint32_t y = 0; y < surface.height; ++y) {
      uint32_t row = 0;
      for (uint32_t x = 0; x < surface.width; ++x, ++here) {
        const bool left = x > 0 && here[0] != here[-1];
        const bool above = y > 0 && here[0] != *(here - surface.width);
        row += left || above;
        sums_[(y + size_t{1}) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + row;
      }
    }
  }

  /// From first to last, both included.
  bool none(GridPoint first, GridPoint last) const {
    const size_t above = first.y * stride_, below = (last.y + size_t{1}) * stride_;
    return sums_[below + last.x + 1] - sums_[above + last.x + 1] ==
           sums_[below + first.x] - sums_[above + first.x];
  }

 private:
  size_t stride_;
  std::vector<uint32_t> sums_;
};

// withoutNeedless() takes the vertices on water out of a mesh, where they take triangles and lower
// no error. Decimation puts them last, so they are in a mesh if its budget is more than the ground
// around the water can use.

/// A closed set without the vertices around which all samples have one height, as far as they and
/// their descendants reach: a closed set again.
std::vector<VertexId> withoutNeedless(const Lattice& lattice, const SurfaceView& surface,
                                      std::vector<VertexId> vertices) {
  assert(surface.width == lattice.width() && surface.height == lattice.height());
  const Changes changes(surface);
  std::erase_if(vertices, [&](VertexId v) {
    const Site site = lattice.site(v);
    const GridPoint at = lattice.position(site);
    // The octagon of the vertex (topology/lattice_mesh.hpp), and one triangle beyond.
    const uint32_t reach = (Lattice::isCentre(site.level) ? 3 : 2) * lattice.plan(site.level).step;
    const GridPoint first{at.x - std::min(at.x, reach), at.y - std::min(at.y, reach)};
    return changes.none(lattice.clamp(first), lattice.clamp({at.x + reach, at.y + reach}));
  });
  return vertices;
}

}  // namespace

// Chosen on one level, fitted on the next finer one.

namespace {

/// Samples for each triangle that are left where fine levels are skipped, and the same where
/// nothing is known of the finer levels. More samples fit meshes a little better, and take time.
constexpr uint64_t kPerTriangle = 5, kPerQuietTriangle = 1;

/// Finest levels that can be left out with so many samples left for each triangle.
uint32_t spareLevels(const Lattice& lattice, uint64_t per_triangle, uint32_t max_triangles) {
  const uint32_t shorter = std::min(lattice.width(), lattice.height()) - 1;
  const auto spare = [&](uint32_t levels) {
    return shorter >> levels > 0 &&
           lattice.sampleCount() >> (2 * levels) >= per_triangle * max_triangles;
  };
  uint32_t k = 0;
  while (spare(k + 1)) ++k;
  return k;
}

/// The surface without the levels below `level`, of which nothing is known.
KnownSurface fromLevel(uint32_t level, KnownSurface known) {
  if (level <= known.level) return known;
  return {coarsen(known.surface.view(), level - known.level), level, known.quiet_level,
          known.row_weights};
}

/// Of the samples of a coarse surface with every 2^k-th row; none where rows count alike.
std::vector<float> sampleWeights(std::span<const float> rows, const SurfaceView& surface,
                                 uint32_t k) {
  std::vector<float> weights;
  if (rows.empty()) return weights;
  weights.reserve(size_t{surface.width} * surface.height);
  for (uint32_t y = 0; y < surface.height; ++y)
    weights.insert(weights.end(), surface.width, rows[std::min(size_t{y} << k, rows.size() - 1)]);
  return weights;
}

Result<std::vector<VertexId>> chosenVertices(const SurfaceView& surface, uint32_t max_triangles) {
  const Result<FittedSequence> sequence = FittedSequence::makeFor({surface, {}}, max_triangles);
  if (!sequence.ok()) return sequence.status();
  std::vector<VertexId> vertices = sequence->order();
  vertices.resize(sequence->longestPrefix(max_triangles));
  return vertices;
}

Result<BudgetMesh> fittedVertices(const KnownSurface& known, bool choose_coarser,
                                  uint32_t max_triangles) {
  SurfaceView fine = known.surface.view();
  const std::vector<float> weights = sampleWeights(known.row_weights, fine, known.level);
  fine.weights = weights;
  const CoarseSurface coarser = choose_coarser ? smoothed(fine) : CoarseSurface();
  SurfaceView choice = choose_coarser ? coarser.view() : fine;
  std::vector<float> of_choice;
  if (choose_coarser)
    choice.weights = of_choice = sampleWeights(known.row_weights, choice, known.level + 1);
  Result<std::vector<VertexId>> chosen = chosenVertices(choice, max_triangles);
  if (!chosen.ok()) return chosen.status();
  const Result<Lattice> lattice = Lattice::make(fine.width, fine.height);
  if (!lattice.ok()) return lattice.status();
  std::vector<VertexId> vertices = withoutNeedless(*lattice, fine, std::move(*chosen));
  FittedMesh fitted = fitMesh(*lattice, {fine, {}}, vertices);
  return BudgetMesh{std::move(vertices), std::move(fitted.mesh),
                    withinRange({fine, {}}, std::move(fitted.heights))};
}

}  // namespace

uint32_t budgetMeshLevel(const Lattice& lattice, uint32_t max_triangles) {
  return std::max(spareLevels(lattice, kPerTriangle, max_triangles), 1u) - 1;
}

Result<BudgetMesh> budgetMesh(const Lattice& lattice, KnownSurface known, uint32_t max_triangles) {
  assert(max_triangles > 0 && known.level <= known.quiet_level);
  const uint32_t chosen_level = spareLevels(lattice, kPerTriangle, max_triangles);
  const uint32_t quiet_level =
      std::min(known.quiet_level, spareLevels(lattice, kPerQuietTriangle, max_triangles));
  const uint32_t level = std::max(chosen_level, quiet_level);
  if (level > 0) known = fromLevel(level - 1, std::move(known));
  Result<BudgetMesh> fitted = fittedVertices(known, level > 0, max_triangles);
  if (!fitted.ok()) return fitted.status();
  for (uint32_t& sample : fitted->mesh.vertices)
    sample =
        wholeSample(sample, known.surface.width, lattice.width(), lattice.height(), known.level);
  return fitted;
}

namespace {

Result<FittedMesh> latticeMesh(const Lattice& lattice, const WeightedSurface& surface,
                               uint32_t max_triangles,
                               const std::function<Status(uint64_t)>& admits) {
  if (!surface.known.empty()) {
    Result<FittedVertices> beside = verticesBesideVoids(lattice, surface, max_triangles, admits);
    if (!beside.ok()) return beside.status();
    return FittedMesh{meshOf(lattice, beside->vertices), std::move(beside->heights)};
  }
  const Result<FittedSequence> sequence = FittedSequence::makeFor(surface, max_triangles);
  if (!sequence.ok()) return sequence.status();
  std::vector<VertexId> vertices = sequence->order();
  vertices.resize(sequence->longestPrefix(max_triangles));
  return fitMesh(lattice, surface, withoutNeedless(lattice, surface.view, std::move(vertices)));
}

}  // namespace

Result<FittedMesh> screenMesh(const Lattice& lattice, const WeightedSurface& surface,
                              uint32_t max_triangles,
                              const std::function<Status(uint64_t)>& admits) {
  Result<FittedMesh> mesh = latticeMesh(lattice, surface, max_triangles, admits);
  if (!mesh.ok()) return mesh;
  FittedMesh turned = withTurnedEdges(surface, std::move(*mesh));
  return FittedMesh{std::move(turned.mesh), withinRange(surface, std::move(turned.heights))};
}

}  // namespace tetrakis::inline mesh
