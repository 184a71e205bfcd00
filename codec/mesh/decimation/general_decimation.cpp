// SPDX-License-Identifier: Apache-2.0
// Greedy removal of the cheapest merging domain. Slopes are looked at only when a vertex comes up:
// entries of the queue are lower bounds, and falls below them are pushed at once.
#include "codec/mesh/decimation/general_decimation.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "codec/mesh/decimation/slope_queue.hpp"

namespace tetrakis::inline decimation {
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

}  // namespace tetrakis::inline decimation
