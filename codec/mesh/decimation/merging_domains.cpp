// SPDX-License-Identifier: Apache-2.0
// The vertices of a domain; domains of coarse vertices.
#include "codec/mesh/decimation/merging_domains.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/decimation/complete_domains.hpp"

namespace tetrakis::inline decimation {

MergingDomains::MergingDomains(const std::vector<double>& gains, const VertexCosts& costs,
                               uint32_t prompt_levels)
    : gains_(&gains),
      costs_(&costs),
      sums_(costs.lattice()),
      domains_(completeDomains(gains, costs)),
      deferred_(costs.lattice(), costs.lattice().levelCount() -
                                     std::min(costs.lattice().levelCount(), prompt_levels)),
      removed_(gains.size()),
      remaining_(gains.size()) {
  assert(prompt_levels > 0 && prompt_levels % 2 == 0);
  const VertexId late = lattice().firstOf(deferred_.level());
  late_.reserve(late);
  for (VertexId v = 0; v < late; ++v) late_.push_back({domains_[v].distortion, domains_[v].cost});
}

Worth MergingDomains::worth(VertexId v) const {
  if (v >= late_.size()) return {domains_[v].distortion, domains_[v].cost};
  Worth worth = late_[v];
  worth -= deferred_.of(lattice().site(v));
  return worth;
}

void MergingDomains::refresh(VertexId v) {
  const Worth now = worth(v);
  domains_[v].distortion = now.distortion;
  domains_[v].cost = now.cost;
}

/// Makes room for more vertices of a group, but never for more than remain: the first group of a
/// flat surface is all of its vertices.
void MergingDomains::makeRoom() {
  const size_t room = std::min(2 * sites_.size(), remaining_);
  sites_.reserve(room);
  group_.reserve(room);
}

/// The remaining vertices of M_v, level by level.
void MergingDomains::collect(VertexId v) {
  assert(!removed_[v]);
  sites_.assign(1, lattice().site(v));
  group_.assign(1, v);
  removed_[v] = true;
  for (size_t i = 0; i < sites_.size(); ++i)
    lattice().forEachChild(Site(sites_[i]), [&](Site child) {
      const VertexId w = lattice().id(child);
      if (removed_[w]) return;
      removed_[w] = true;
      __builtin_prefetch(&(*gains_)[w]);
      if (sites_.size() == sites_.capacity()) [[unlikely]]
        makeRoom();
      sites_.push_back(child);
      group_.push_back(w);
    });
  remaining_ -= group_.size();
}

/// Removes a domain of one vertex that saves something, so that no slope falls.
void MergingDomains::removeSingle(Site site, const Worth& worth) {
  assert(group_.size() == 1 && worth.cost > 0);
  const auto lose = [&](VertexId a) { domains_[a] -= worth; };
  AncestorWindow last = AncestorWindow::ofSquare(site);
  forEachAncestorWindow(lattice(), site, deferred_.level(),
                        [&](uint32_t level, const AncestorWindow& window) {
                          window.visit(level, lattice().plan(level), lose);
                          last = window;
                        });
  deferred_.add(last, worth);
}

/// Coarse vertices of the group leave the domains of their ancestors.
void MergingDomains::loseLate() {
  for (size_t i = 0; i < group_.size() && group_[i] < late_.size(); ++i)
    forEachAncestor(lattice(), sites_[i],
                    [&](VertexId a) { late_[a] -= worthOf(sites_[i], group_[i]); });
}

/// All of M_v was kept for the squares above v: a part also goes to others.
void MergingDomains::deferPart(const AncestorWindow& squares, const AncestorWindow& taken,
                               const Worth& part) {
  deferred_.add(squares, part);
  if (taken.cells != 0) deferred_.takeBack(taken, part);
}

}  // namespace tetrakis::inline decimation
