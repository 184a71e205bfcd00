// SPDX-License-Identifier: Apache-2.0
// MergingDomains tells at any time of a decimation what the removal of a vertex with all of its
// remaining descendants costs and saves, from the gains and costs of single vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/decimation/deferred_losses.hpp"
#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/topology/ancestors.hpp"

namespace tetrakis::inline decimation {

// MergingDomains keeps, while vertices are removed, the error and the cost that the removal of each
// merging domain M_v (v and its remaining descendants) would add and save (thesis 5.3.1). The worth
// of a removed vertex is subtracted from the domain of each of its ancestors exactly once, which is
// the inclusion and exclusion over intersections of domains (thesis 3.4.4). Sums of gains are exact
// (gains/gains.hpp), and so are all values at all times.

class MergingDomains {
 public:
  /// The number of levels, from the finest on, whose domains are updated at every removal. The
  /// coarser levels hold one vertex in four thousand but two fifths of all ancestors at 1025 x
  /// 1025; their domains are summed up when their values are asked for.
  static constexpr uint32_t kPromptLevels = 12;

  /// Begins with complete domains: no vertex is removed. gains: one for each vertex. Both arguments
  /// must outlive the domains. prompt_levels: even.
  MergingDomains(const std::vector<double>& gains, const VertexCosts& costs,
                 uint32_t prompt_levels = kPromptLevels);

  /// u(M_v), thesis (5.3), of a vertex v that is not removed.
  Worth worth(VertexId v) const;
  double slope(VertexId v) {
    if (v < late_.size()) refresh(v);
    return slopeOf(domains_[v].distortion, domains_[v].cost);
  }
  bool removed(VertexId v) const { return removed_[v]; }
  /// Asks the processor to load u(M_v) into its cache.
  void prefetch(VertexId v) const { __builtin_prefetch(&domains_[v]); }
  /// Sets the slope below which remove() reports v. bound: at most slope(v).
  void setBound(VertexId v, float bound) { domains_[v].bound = bound; }

  /// Removes M_v, which must have the least slope of all domains, and returns its vertices, parents
  /// first. Calls onFall(VertexId) for each vertex whose slope has fallen below its bound; the call
  /// may set a new bound. (If another domain is removed, values stay right but falls may go
  /// unreported.)
  template <class OnFall>
  std::span<const VertexId> remove(VertexId v, OnFall&& onFall);

 private:
  /// Takes parts of M_v off the domains that hold them.
  template <class OnFall>
  struct Lose {
    MergingDomains& domains;
    OnFall& onFall;

    void operator()(VertexId a, const Worth& part) { domains.subtract(a, part, onFall); }
    void pass(uint32_t level, const AncestorWindow& squares, const AncestorWindow& taken,
              const Worth& part) {
      if (level == domains.deferred_.level()) domains.deferPart(squares, taken, part);
    }
  };

  const Lattice& lattice() const { return costs_->lattice(); }
  Worth worthOf(Site site, VertexId v) const { return {(*gains_)[v], costs_->of(site, v)}; }
  void refresh(VertexId v);
  void collect(VertexId v);
  void makeRoom();
  void removeSingle(Site site, const Worth& worth);
  void loseLate();
  void deferPart(const AncestorWindow& squares, const AncestorWindow& taken, const Worth& part);
  template <class OnFall>
  void reportLateFalls(OnFall& onFall);
  template <class OnFall>
  void subtract(VertexId a, const Worth& worth, OnFall& onFall);
  template <class OnFall>
  void report(VertexId a, OnFall& onFall);

  const std::vector<double>* gains_;
  const VertexCosts* costs_;
  AncestorSums<Worth> sums_;
  /// Domains of the vertices of late_ may lack losses, which do not lower their slopes.
  std::vector<DomainWorth> domains_;
  std::vector<Worth> late_;  ///< domains of coarse vertices, without the losses in deferred_
  DeferredLosses deferred_;
  std::vector<bool> removed_;
  size_t remaining_;              ///< vertices that are not removed
  std::vector<VertexId> fallen_;  ///< coarse vertices that may have fallen
  std::vector<Site> sites_;       ///< of the group that is being removed
  std::vector<VertexId> group_;
};

/// The domain of every ancestor of v loses all of M_v. M_v has the least slope, so the slope of no
/// ancestor falls if M_v frees triangles. (A domain that frees none and does not increase the error
/// has slope -infinity, and among equal slopes the coarser vertex is removed first, so none of its
/// ancestors is left with that slope.) Where domains overlap, other domains lose parts of M_v, and
/// their slopes may fall (thesis 5.4.2).
template <class OnFall>
std::span<const VertexId> MergingDomains::remove(VertexId v, OnFall&& onFall) {
  const Worth all = worth(v);
  collect(v);
  const Site site = sites_[0];
  const bool late = v < late_.size();
  if (late) loseLate();
  if (!late && all.cost > 0 && group_.size() == 1) {
    removeSingle(site, all);
    return group_;
  }
  Lose<OnFall> lose{*this, onFall};
  const auto lose_all = [&](uint32_t level, const AncestorWindow& window) {
    const auto lose_one = [&](VertexId a) {
      if (all.cost > 0)
        domains_[a] -= all;
      else
        lose(a, all);
    };
    window.visit(level, lattice().plan(level), lose_one);
  };
  sums_.takeAncestorsOf(site, late || all.cost == 0 ? 0 : deferred_.level(), lose_all);
  if (!late) deferred_.add(sums_.taken(deferred_.level()), all);
  for (size_t i = group_.size(); i-- > 1;)
    sums_.add(sites_[i], worthOf(sites_[i], group_[i]), lose);
  sums_.flush(lose);
  reportLateFalls(onFall);
  return group_;
}

/// Reports coarse vertices. Called once all losses of the group are known, because only then is a
/// sum of deferred_ the whole loss.
template <class OnFall>
void MergingDomains::reportLateFalls(OnFall& onFall) {
  for (const VertexId a : fallen_) {
    const auto bound = static_cast<double>(domains_[a].bound);
    if (slope(a) < bound) onFall(a);
  }
  fallen_.clear();
}

template <class OnFall>
inline void MergingDomains::subtract(VertexId a, const Worth& worth, OnFall& onFall) {
  DomainWorth& domain = domains_[a];
  domain -= worth;
  // Without a division; the product is exact while costs add up to less than 2^29.
  const double least = static_cast<double>(domain.bound) * domain.cost;
  if (domain.distortion > least && domain.cost > 0) [[likely]]
    return;
  report(a, onFall);
}

/// Reports a if its slope has fallen below its bound.
template <class OnFall>
[[gnu::noinline]] void MergingDomains::report(VertexId a, OnFall& onFall) {
  if (removed_[a]) return;
  if (a < late_.size())
    fallen_.push_back(a);
  else if (slopeOf(domains_[a].distortion, domains_[a].cost) <
           static_cast<double>(domains_[a].bound))
    onFall(a);
}

}  // namespace tetrakis::inline decimation
