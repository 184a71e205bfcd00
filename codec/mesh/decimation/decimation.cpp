// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/decimation/decimation.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/decimation/slope_queue.hpp"
#include "codec/mesh/gains/gains.hpp"

namespace tetrakis::inline decimation {

std::vector<VertexId> saturatedOrder(const std::vector<double>& errors, const VertexCosts& costs,
                                     uint64_t most) {
  constexpr double kLeast = -std::numeric_limits<double>::infinity();
  const Lattice& lattice = costs.lattice();
  assert(errors.size() == lattice.vertexCount());
  std::vector<Candidate> order(errors.size());
  uint64_t free = 0;
  lattice.forEachVertex([&](Site site, VertexId v) {
    const uint32_t cost = costs.of(site, v);
    order[v] = {cost > 0 ? -errors[v] / cost : -kLeast, v};
    free += cost == 0;
  });
  for (VertexId v = lattice.vertexCount(); v-- > 0;)
    lattice.forEachParent(lattice.site(v), [&](Site parent) {
      double& slope = order[lattice.id(parent)].slope;
      slope = std::min(slope, order[v].slope);
    });
  const auto wanted = static_cast<size_t>(std::min<uint64_t>(order.size(), most + free));
  // By pointers, as std::sort does it: they share their code.
  std::nth_element(order.data(), order.data() + wanted, order.data() + order.size());
  order.resize(wanted);
  std::sort(order.begin(), order.end());
  std::vector<VertexId> vertices;
  vertices.reserve(order.size());
  for (const Candidate& candidate : order) vertices.push_back(candidate.vertex);
  return vertices;
}

// Greedy removal of the cheapest merging domain. Slopes are looked at only when a vertex comes up:
// entries of the queue are lower bounds, and falls below them are pushed at once.

namespace {

double sumOfPositive(const std::vector<double>& gains) {
  double sum = 0;
  for (const double g : gains) sum += std::max(g, 0.0);
  return sum;
}

class Decimator {
 public:
  Decimator(const std::vector<double>& gains, const VertexCosts& costs, uint32_t prompt_levels,
            std::vector<uint32_t>* steps)
      : count_(gains.size()),
        steps_(steps),
        domains_(gains, costs, prompt_levels),
        queue_(sumOfPositive(gains), gains.size()) {
    for (VertexId v = 0; v < count_; ++v) enqueue(v);
  }

  /// All vertices, those removed last first.
  std::vector<VertexId> run() {
    const auto enqueue_remaining = [this](std::span<const VertexId> vertices) {
      for (const VertexId v : vertices) domains_.prefetch(v);
      for (const VertexId v : vertices)
        if (!domains_.removed(v)) enqueue(v);
    };
    order_.reserve(count_);
    while (order_.size() < count_) {
      assert(order_.size() < count_);
      const Candidate least = queue_.pop(enqueue_remaining);
      if (domains_.removed(least.vertex)) continue;
      const double slope = domains_.slope(least.vertex);
      if (slope == least.slope || queue_.isFirst({slope, least.vertex}))
        remove(least.vertex);
      else
        enqueue(least.vertex);
    }
    std::reverse(order_.begin(), order_.end());
    return std::move(order_);
  }

 private:
  void enqueue(VertexId v) { domains_.setBound(v, queue_.push({domains_.slope(v), v})); }

  void remove(VertexId v) {
    const auto group = domains_.remove(v, [this](VertexId a) { enqueue(a); });
    order_.insert(order_.end(), group.rbegin(), group.rend());
    if (steps_ != nullptr) steps_->push_back(static_cast<uint32_t>(group.size()));
  }

  size_t count_;
  std::vector<uint32_t>* steps_;
  MergingDomains domains_;
  SlopeQueue queue_;
  std::vector<VertexId> order_;
};

}  // namespace

std::vector<VertexId> generalDecimation(const std::vector<double>& gains, const VertexCosts& costs,
                                        uint32_t prompt_levels, std::vector<uint32_t>* steps) {
  return Decimator(gains, costs, prompt_levels, steps).run();
}

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
