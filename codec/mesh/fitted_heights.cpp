// SPDX-License-Identifier: Apache-2.0
// Stages of decimation between fits.
#include "codec/mesh/fitted_heights.hpp"

#include <iterator>
#include <span>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/gains/gains.hpp"

namespace tetrakis::inline mesh {

namespace {

/// Halves and sevenths of the triangles that are wanted: those of the first stage and of the
/// second. Twice as many triangles at first, or one stage more, change less than half a percent,
/// and take time.
constexpr uint64_t kFirstHalves = 3, kSecondSevenths = 8;
/// Samples for a triangle of the finest mesh whose order is refined for all budgets; each mesh has
/// half of the triangles of the one before. Fewer samples take time.
constexpr size_t kSamplesForATriangle = 4;

/// Triangles of the first of the stages for one mesh.
uint64_t firstStage(uint32_t wanted) {
  return wanted * kFirstHalves / 2;
}

}  // namespace

Result<FittedSequence> FittedSequence::make(const WeightedSurface& surface) {
  Result<MeshSequence> greedy = decimate(surface.view);
  if (!greedy.ok()) return greedy.status();
  FittedSequence sequence(greedy->lattice(), surface, greedy->order());
  sequence.refine();
  return sequence;
}

Result<FittedSequence> FittedSequence::makeFor(const WeightedSurface& surface, uint32_t triangles) {
  Result<Lattice> lattice = Lattice::make(surface.view.width, surface.view.height);
  if (!lattice.ok()) return lattice.status();
  if (const Status status = checkWeights(surface.view); !status.ok()) return status;
  std::vector<VertexId> order = saturatedOrder(vertexGains(*lattice, surface.view),
                                               VertexCosts(*lattice), firstStage(triangles));
  FittedSequence sequence(std::move(*lattice), surface, std::move(order));
  sequence.refineFor(triangles);
  return sequence;
}

FittedSequence::FittedSequence(Lattice lattice, const WeightedSurface& surface,
                               std::vector<VertexId> order)
    : lattice_(std::move(lattice)), surface_(surface), order_(std::move(order)) {}

/// Above a quarter of a triangle a sample the samples themselves nearly fit.
void FittedSequence::refine() {
  FittedMoments fitted(lattice_, surface_);
  for (size_t triangles = lattice_.sampleCount() / kSamplesForATriangle; triangles > 0;
       triangles /= 2) {
    const size_t count = longestPrefix(static_cast<uint32_t>(triangles));
    if (count == 0) return;
    fitted.coarsen(std::span(order_).first(count));
    fitHeights(fitted);
    sortBySlope(count, fitted);
  }
}

/// Two stages, close to the mesh that is wanted, each of which settles which vertices the next one
/// has. Above a triangle a sample the samples themselves nearly fit.
void FittedSequence::refineFor(uint32_t wanted) {
  FittedMoments fitted(lattice_, surface_);
  const uint64_t stages[] = {firstStage(wanted), wanted * kSecondSevenths / 7, wanted};
  for (size_t stage = 0; stage + 1 < std::size(stages); ++stage) {
    if (stages[stage] > lattice_.sampleCount()) continue;
    const size_t count = longestPrefix(static_cast<uint32_t>(stages[stage]));
    fitted.coarsen(std::span(order_).first(count));
    fitHeights(fitted);
    sortBySide(count, fitted, static_cast<uint32_t>(stages[stage + 1]));
  }
}

/// The first `count` vertices, those of the mesh; equal slopes keep their order.
void FittedSequence::sortBySlope(size_t count, const FittedMoments& fitted) {
  const std::span<VertexId> first = std::span(order_).first(count);
  const std::vector<VertexId> vertices = ascending(first);
  sortByKeys(vertices, closureSlopes(lattice_, vertices, fitted.gains(vertices)), first);
}

/// Sorts the first vertices so that the best of them for so many triangles come first.
void FittedSequence::sortBySide(size_t count, const FittedMoments& fitted, uint32_t triangles) {
  const std::span<VertexId> first = std::span(order_).first(count);
  const std::vector<VertexId> vertices = ascending(first);
  sortByKeys(vertices, hullSides(lattice_, vertices, fitted.gains(vertices), triangles), first);
}

size_t FittedSequence::longestPrefix(uint32_t triangles) const {
  size_t count = 2 * size_t{lattice_.rootColumns()} * lattice_.rootRows();
  size_t inserted = 0;
  for (; inserted < order_.size(); ++inserted) {
    count += lattice_.triangleCost(lattice_.site(order_[inserted]));
    if (count > triangles) break;
  }
  return inserted;
}

FittedMesh FittedSequence::mesh(size_t inserted) const {
  return fitMesh(lattice_, surface_, std::span(order_).first(inserted));
}

FittedMesh fitMesh(const Lattice& lattice, const WeightedSurface& surface,
                   std::span<const VertexId> vertices) {
  FittedMoments fitted(lattice, surface);
  fitted.coarsen(vertices);
  fitHeights(fitted);
  FittedMesh result{meshOf(lattice, vertices), {}};
  for (const uint32_t sample : result.mesh.vertices)
    result.heights.push_back(fitted.height(sample));
  return result;
}

}  // namespace tetrakis::inline mesh
