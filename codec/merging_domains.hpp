// SPDX-License-Identifier: Apache-2.0
// What removing each merging domain M_v (v and its remaining descendants) would cost and save, kept
// up while vertices are removed (thesis 5.3.1). Removed vertices are taken off all their ancestors,
// once each: that is the inclusion and exclusion over intersections of domains (thesis 3.4.4), and
// as sums of gains are exact (gains.hpp), so are all values at all times.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/ancestors.hpp"
#include "codec/vertex_costs.hpp"
#include "codec/worth.hpp"

namespace tetrakis {

class MergingDomains {
 public:
  /// Complete domains. gains: one for each vertex. Both arguments must outlive the domains.
  MergingDomains(const std::vector<double>& gains, const VertexCosts& costs);

  /// u(M_v), thesis (5.3), of a remaining vertex.
  Worth worth(VertexId v) const { return {domains_[v].distortion, domains_[v].cost}; }
  double slope(VertexId v) const { return slopeOf(domains_[v].distortion, domains_[v].cost); }
  bool removed(VertexId v) const { return removed_[v]; }
  /// Brings u(M_v) close, if the processor can.
  void prefetch(VertexId v) const { __builtin_prefetch(&domains_[v]); }
  /// remove() reports v when its slope has become less than this.
  void setBound(VertexId v, float bound) { domains_[v].bound = bound; }

  /// Removes M_v, which has the least slope of all, and returns its vertices, parents first. (Of
  /// any other domain the values will be right, too, but not all falls reported.) onFall(VertexId)
  /// may set a new bound.
  template <class OnFall>
  std::span<const VertexId> remove(VertexId v, OnFall&& onFall);

 private:
  const Lattice& lattice() const { return costs_->lattice(); }
  Worth worthOf(Site site, VertexId v) const { return {(*gains_)[v], costs_->of(site, v)}; }
  void collect(VertexId v);
  template <class OnFall>
  void subtract(VertexId a, const Worth& worth, OnFall& onFall);

  const std::vector<double>* gains_;
  const VertexCosts* costs_;
  AncestorSums<Worth> sums_;
  std::vector<DomainWorth> domains_;
  std::vector<bool> removed_;
  std::vector<Site> sites_;  ///< of the group that is being removed
  std::vector<VertexId> group_;
};

/// Every ancestor of v loses all of M_v, which has the least slope: none of theirs falls, if M_v
/// saves anything. (Nor is a domain left that saves nothing and does no harm: its slope was the
/// same, and the coarser vertex goes first.) Where domains overlap, others lose parts of M_v and
/// may fall (thesis 5.4.2).
template <class OnFall>
std::span<const VertexId> MergingDomains::remove(VertexId v, OnFall&& onFall) {
  const Worth all = worth(v);
  collect(v);
  const auto loseAll = [&](VertexId a) { domains_[a] -= all; };
  const auto lose = [&](VertexId a, const Worth& part) { subtract(a, part, onFall); };
  if (all.cost > 0 && group_.size() == 1) {
    forEachAncestor(lattice(), sites_[0], loseAll);
    return group_;
  }
  if (all.cost > 0)
    sums_.takeAncestorsOf(sites_[0], loseAll);
  else
    sums_.takeAncestorsOf(sites_[0], [&](VertexId a) { lose(a, all); });
  for (size_t i = group_.size(); i-- > 1;)
    sums_.add(sites_[i], worthOf(sites_[i], group_[i]), lose);
  sums_.flush(lose);
  return group_;
}

template <class OnFall>
void MergingDomains::subtract(VertexId a, const Worth& worth, OnFall& onFall) {
  DomainWorth& domain = domains_[a];
  domain -= worth;
  // Without a division; the product is exact while costs add up to less than 2^29.
  const double least = static_cast<double>(domain.bound) * domain.cost;
  if (domain.distortion > least && domain.cost > 0) return;
  if (!removed_[a] && slope(a) < static_cast<double>(domain.bound)) onFall(a);
}

}  // namespace tetrakis
