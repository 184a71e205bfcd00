// SPDX-License-Identifier: Apache-2.0
// Chosen on one level, fitted on the next finer one.
#include "codec/mesh/budget_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/fitting/height_range.hpp"
#include "codec/mesh/needless_vertices.hpp"

namespace tetrakis::inline mesh {

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
  return {coarsen(known.surface.view(), level - known.level), level, known.quiet_level};
}

Result<std::vector<VertexId>> chosenVertices(const SurfaceView& surface, uint32_t max_triangles) {
  const Result<FittedSequence> sequence = FittedSequence::makeFor({surface, {}}, max_triangles);
  if (!sequence.ok()) return sequence.status();
  std::vector<VertexId> vertices = sequence->order();
  vertices.resize(sequence->longestPrefix(max_triangles));
  return vertices;
}

Result<BudgetMesh> fittedVertices(const CoarseSurface& surface, bool choose_coarser,
                                  uint32_t max_triangles) {
  const SurfaceView fine = surface.view();
  const CoarseSurface coarser = choose_coarser ? smoothed(fine) : CoarseSurface();
  Result<std::vector<VertexId>> chosen =
      chosenVertices(choose_coarser ? coarser.view() : fine, max_triangles);
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
  Result<BudgetMesh> fitted = fittedVertices(known.surface, level > 0, max_triangles);
  if (!fitted.ok()) return fitted.status();
  for (uint32_t& sample : fitted->mesh.vertices)
    sample =
        wholeSample(sample, known.surface.width, lattice.width(), lattice.height(), known.level);
  return fitted;
}

}  // namespace tetrakis::inline mesh
