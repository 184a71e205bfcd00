// SPDX-License-Identifier: Apache-2.0
// Stages of decimation between fits.
#include "codec/fitted_heights.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "codec/closure.hpp"
#include "codec/decimation.hpp"
#include "codec/fitted_solver.hpp"

namespace tetrakis {

Result<FittedSequence> FittedSequence::make(const WeightedSurface& surface, uint32_t triangles) {
  Result<MeshSequence> greedy = decimate(surface.view);
  if (!greedy.ok()) return greedy.status();
  FittedSequence sequence(greedy->lattice(), surface, greedy->order());
  sequence.refine(triangles);
  return sequence;
}

FittedSequence::FittedSequence(Lattice lattice, const WeightedSurface& surface,
                               std::vector<VertexId> order)
    : lattice_(std::move(lattice)), surface_(surface), order_(std::move(order)) {}

/// Above a quarter of a triangle a sample the samples themselves nearly fit, and what is sorted far
/// above the triangles that are wanted (0: any number) hardly shows in their mesh, what is sorted
/// below not at all.
void FittedSequence::refine(uint32_t wanted) {
  FittedMoments fitted(lattice_, surface_);
  size_t triangles = lattice_.sampleCount() / 4;
  while (wanted > 0 && triangles / 4 >= wanted) triangles /= 2;
  for (; triangles > 0 && triangles >= wanted; triangles /= 2) {
    const size_t count = longestPrefix(static_cast<uint32_t>(triangles));
    if (count == 0) return;
    fitted.coarsen(std::span(order_).first(count));
    fitHeights(fitted);
    sortBySlope(count, fitted);
  }
}

/// The first `count` vertices, those of the mesh; equal slopes keep their order.
void FittedSequence::sortBySlope(size_t count, const FittedMoments& fitted) {
  const auto end = order_.begin() + static_cast<ptrdiff_t>(count);
  std::vector<VertexId> vertices(order_.begin(), end);
  std::sort(vertices.begin(), vertices.end());
  const std::vector<double> slopes = closureSlopes(lattice_, vertices, fitted.gains(vertices));
  std::vector<double> slope_of(lattice_.vertexCount());
  for (size_t i = 0; i < count; ++i) slope_of[vertices[i]] = slopes[i];
  std::stable_sort(order_.begin(), end,
                   [&](VertexId v, VertexId w) { return slope_of[v] > slope_of[w]; });
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

}  // namespace tetrakis
