// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/decimation/decimation.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/decimation/general_decimation.hpp"
#include "codec/mesh/gains/gains.hpp"

namespace tetrakis::inline decimation {
namespace {

/// Triangles up to which meshes are made the best ones by minimum cuts, and samples for each of
/// these triangles at least. More triangles take 7 times the time of decimation for 0.02 dB.
constexpr size_t kBestTriangles = 4096, kSamplesForBest = 8;

/// Greedy steps cost most where few triangles are left, up to 0.2 dB below 500; there the best
/// meshes are cheap to know.
void improveCoarsest(const Lattice& lattice, const std::vector<double>& gains,
                     std::vector<VertexId>& order) {
  const auto most = static_cast<uint32_t>(
      std::min<size_t>(kBestTriangles, lattice.sampleCount() / kSamplesForBest));
  uint32_t triangles = 2 * lattice.rootColumns() * lattice.rootRows();
  size_t count = 0;
  for (; count < order.size() && triangles < most; ++count)
    triangles += lattice.triangleCost(lattice.site(order[count]));
  sortThroughCorners(lattice, gains, std::span(order).first(count));
}

}  // namespace

MeshSequence::MeshSequence(Lattice lattice, std::vector<VertexId> order,
                           const std::vector<double>& gains)
    : lattice_(std::move(lattice)),
      order_(std::move(order)),
      triangle_counts_(order_.size() + 1),
      squared_errors_(order_.size() + 1) {
  assert(order_.size() == lattice_.vertexCount() && gains.size() == order_.size());
  std::vector<uint8_t> costs(order_.size());
  lattice_.forEachVertex(
      [&](Site site, VertexId v) { costs[v] = static_cast<uint8_t>(lattice_.triangleCost(site)); });
  triangle_counts_[0] = 2 * lattice_.rootColumns() * lattice_.rootRows();
  for (size_t i = 0; i < order_.size(); ++i)
    triangle_counts_[i + 1] = triangle_counts_[i] + costs[order_[i]];
  double error = 0;
  for (size_t i = order_.size(); i-- > 0;) {
    error += gains[order_[i]];
    squared_errors_[i] = std::max(error, 0.0);  // rounding of the gains
  }
}

size_t MeshSequence::bestPrefix(uint32_t triangles) const {
  const auto end =
      std::upper_bound(triangle_counts_.begin() + 1, triangle_counts_.end(), triangles);
  const auto allowed = end - triangle_counts_.begin();
  const auto best = std::min_element(squared_errors_.begin(), squared_errors_.begin() + allowed);
  return static_cast<size_t>(best - squared_errors_.begin());
}

LatticeMesh MeshSequence::mesh(size_t inserted) const {
  assert(inserted <= order_.size());
  return meshOf(lattice_, std::span(order_).first(inserted));
}

Result<MeshSequence> decimate(const SurfaceView& surface) {
  Result<Lattice> lattice = Lattice::make(surface.width, surface.height);
  if (!lattice.ok()) return lattice.status();
  if (const Status status = checkWeights(surface); !status.ok()) return status;
  const std::vector<double> gains = vertexGains(*lattice, surface);
  std::vector<VertexId> order = generalDecimation(gains, VertexCosts(*lattice, {}));
  improveCoarsest(*lattice, gains, order);
  return MeshSequence(std::move(*lattice), std::move(order), gains);
}

}  // namespace tetrakis::inline decimation
