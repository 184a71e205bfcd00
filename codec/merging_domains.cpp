// SPDX-License-Identifier: Apache-2.0
// The vertices of a domain.
#include "codec/merging_domains.hpp"

#include "codec/complete_domains.hpp"

namespace tetrakis {

MergingDomains::MergingDomains(const std::vector<double>& gains, const VertexCosts& costs)
    : gains_(&gains),
      costs_(&costs),
      sums_(costs.lattice()),
      domains_(completeDomains(gains, costs)),
      removed_(gains.size()) {}

/// The remaining vertices of M_v, level by level.
void MergingDomains::collect(VertexId v) {
  sites_.assign(1, lattice().site(v));
  group_.assign(1, v);
  removed_[v] = true;
  for (size_t i = 0; i < sites_.size(); ++i)
    lattice().forEachChild(Site(sites_[i]), [&](Site child) {
      const VertexId w = lattice().id(child);
      if (removed_[w]) return;
      removed_[w] = true;
      sites_.push_back(child);
      group_.push_back(w);
    });
}

}  // namespace tetrakis
