// SPDX-License-Identifier: Apache-2.0
#include "bench/reproduction/thesis_direct.hpp"

#include <algorithm>
#include <cstdint>

#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/topology/ancestors.hpp"

namespace tetrakis::bench {
namespace {

class DirectDecimator {
 public:
  DirectDecimator(const std::vector<double>& gains, const VertexCosts& costs)
      : gains_(gains),
        costs_(costs),
        removed_(gains.size()),
        seen_(gains.size()),
        slopes_(gains.size()) {}

  std::vector<VertexId> run() {
    for (VertexId v = 0; v < slopes_.size(); ++v) renew(v);
    std::vector<VertexId> order, stale;
    while (order.size() < slopes_.size()) {
      const std::vector<VertexId> group = domainOf(leastOfAll());
      // Children have greater ids than their parents and go first.
      order.insert(order.end(), group.rbegin(), group.rend());
      stale.clear();
      ++round_;
      for (const VertexId w : group) removed_[w] = true;
      for (const VertexId w : group)
        forEachAncestor(lattice(), lattice().site(w), [&](VertexId a) {
          if (removed_[a] || seen_[a] == round_) return;
          seen_[a] = round_;
          stale.push_back(a);
        });
      for (const VertexId a : stale) renew(a);
    }
    std::reverse(order.begin(), order.end());
    return order;
  }

 private:
  const Lattice& lattice() const { return costs_.lattice(); }

  /// Of equal slopes the coarser vertex.
  VertexId leastOfAll() const {
    VertexId least = 0;
    while (removed_[least]) ++least;
    for (VertexId v = least + 1; v < slopes_.size(); ++v)
      if (!removed_[v] && slopes_[v] < slopes_[least]) least = v;
    return least;
  }

  std::vector<VertexId> domainOf(VertexId v) {
    ++round_;
    std::vector<VertexId> domain(1, v);
    seen_[v] = round_;
    for (size_t i = 0; i < domain.size(); ++i)
      lattice().forEachChild(lattice().site(domain[i]), [&](Site child) {
        const VertexId w = lattice().id(child);
        if (removed_[w] || seen_[w] == round_) return;
        seen_[w] = round_;
        domain.push_back(w);
      });
    std::sort(domain.begin(), domain.end());
    return domain;
  }

  void renew(VertexId v) {
    Worth worth;
    for (const VertexId w : domainOf(v)) worth += Worth{gains_[w], costs_.of(lattice().site(w), w)};
    slopes_[v] = slopeOf(worth.distortion, worth.cost);
  }

  const std::vector<double>& gains_;
  const VertexCosts& costs_;
  std::vector<bool> removed_;
  std::vector<uint32_t> seen_;
  std::vector<double> slopes_;
  uint32_t round_ = 0;
};

}  // namespace

std::vector<VertexId> directDecimation(const std::vector<double>& gains, const VertexCosts& costs) {
  return DirectDecimator(gains, costs).run();
}

}  // namespace tetrakis::bench
