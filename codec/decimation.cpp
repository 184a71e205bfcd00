// SPDX-License-Identifier: Apache-2.0
// Greedy removal of the cheapest merging domain. The sums of gain and triangles over the remaining
// vertices of every M_a are kept exactly: a removed vertex is taken off all its ancestors. Slopes
// are looked at only when a vertex comes up (stale ones are lower bounds), but where domains
// overlap a removal of several vertices can lower an ancestor's slope (thesis 5.4.2): that is
// pushed at once.
#include "codec/decimation.hpp"

#include <algorithm>
#include <limits>

#include "codec/ancestors.hpp"
#include "codec/gains.hpp"
#include "codec/slope_queue.hpp"

namespace tetrakis {
namespace {

enum class State : uint32_t { kPresent, kTouched, kRemoved };

/// What a vertex, or several, are worth: a vector functional u = (D, R) of the thesis.
struct Worth {
  double distortion = 0;
  uint32_t triangles = 0;

  Worth& operator+=(const Worth& other) {
    distortion += other.distortion;
    triangles += other.triangles;
    return *this;
  }
  Worth& operator-=(const Worth& other) {
    distortion -= other.distortion;
    triangles -= other.triangles;
    return *this;
  }
};

/// u(M_v), thesis (5.3): what removing v and its remaining descendants costs and saves.
struct Domain : Worth {
  State state = State::kPresent;

  /// What saves no triangles goes at once if it costs nothing, and as late as it can otherwise.
  double slope() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (triangles == 0) return distortion > 0 ? kInfinity : -kInfinity;
    return distortion / triangles;
  }
};

class Decimator {
 public:
  Decimator(const Lattice& lattice, const std::vector<double>& gains)
      : lattice_(lattice),
        sums_(lattice),
        gains_(gains),
        domains_(gains.size()),
        queue_(sumDomains()) {}

  /// All vertices, in reverse order of removal.
  std::vector<VertexId> run() {
    order_.reserve(domains_.size());
    while (order_.size() < domains_.size()) {
      const VertexId v = queue_.pop().vertex;
      if (domains_[v].state == State::kRemoved) continue;
      const Candidate now{domains_[v].slope(), v};
      if (queue_.isBeforeAll(now))
        remove(v);
      else
        queue_.push(now);
    }
    std::reverse(order_.begin(), order_.end());
    return std::move(order_);
  }

 private:
  std::vector<double> sumDomains() {
    const auto add = [&](VertexId a, const Worth& worth) { domains_[a] += worth; };
    for (VertexId v = 0; v < domains_.size(); ++v) {
      const Site site = lattice_.site(v);
      sums_.add(site, worthOf(site, v), add);
    }
    sums_.flush(add);
    std::vector<double> slopes(domains_.size());
    for (VertexId v = 0; v < domains_.size(); ++v) slopes[v] = domains_[v].slope();
    return slopes;
  }

  Worth worthOf(Site site, VertexId v) const { return {gains_[v], lattice_.triangleCost(site)}; }

  void remove(VertexId v) {
    collect(v);
    if (group_.size() == 1 && domains_[v].triangles > 0)
      updateAncestors(group_[0], v);
    else
      updateAncestorsOfGroup();
    for (size_t i = group_.size(); i-- > 0;) order_.push_back(lattice_.id(group_[i]));
  }

  /// The remaining vertices of M_v, level by level.
  void collect(VertexId v) {
    group_.assign(1, lattice_.site(v));
    domains_[v].state = State::kRemoved;
    for (size_t i = 0; i < group_.size(); ++i)
      lattice_.forEachChild(Site(group_[i]), [&](Site child) {
        State& state = domains_[lattice_.id(child)].state;
        if (state == State::kRemoved) return;
        state = State::kRemoved;
        group_.push_back(child);
      });
  }

  /// A single vertex has the least slope of all: no slope falls. (Nor is a domain left that saves
  /// no triangles and costs nothing: its slope was the same, and the coarser vertex goes first.)
  void updateAncestors(Site site, VertexId v) {
    const Worth worth = worthOf(site, v);
    forEachAncestor(lattice_, site, [&](VertexId a) { domains_[a] -= worth; });
  }

  void updateAncestorsOfGroup() {
    touched_.clear();
    const auto subtract = [&](VertexId a, const Worth& worth) {
      Domain& domain = domains_[a];
      if (domain.state == State::kRemoved) return;
      if (domain.state == State::kPresent) touched_.push_back({domain.slope(), a});
      domain.state = State::kTouched;
      domain -= worth;
    };
    for (size_t i = group_.size(); i-- > 0;)
      sums_.add(group_[i], worthOf(group_[i], lattice_.id(group_[i])), subtract);
    sums_.flush(subtract);
    for (const Candidate& before : touched_) {
      Domain& domain = domains_[before.vertex];
      domain.state = State::kPresent;
      if (domain.slope() < before.slope) queue_.push({domain.slope(), before.vertex});
    }
  }

  const Lattice& lattice_;
  AncestorSums<Worth> sums_;
  const std::vector<double>& gains_;
  std::vector<Domain> domains_;
  SlopeQueue queue_;
  std::vector<Site> group_;
  std::vector<Candidate> touched_;  ///< ancestors of the group and their slopes before
  std::vector<VertexId> order_;
};

}  // namespace

MeshSequence::MeshSequence(Lattice lattice, std::vector<VertexId> order,
                           const std::vector<double>& gains)
    : lattice_(std::move(lattice)),
      order_(std::move(order)),
      triangle_counts_(order_.size() + 1),
      squared_errors_(order_.size() + 1) {
  triangle_counts_[0] = 2 * lattice_.rootColumns() * lattice_.rootRows();
  for (size_t i = 0; i < order_.size(); ++i)
    triangle_counts_[i + 1] = triangle_counts_[i] + lattice_.triangleCost(lattice_.site(order_[i]));
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
  return meshOf(lattice_, std::span(order_).first(inserted));
}

Result<MeshSequence> decimate(const SurfaceView& surface) {
  Result<Lattice> lattice = Lattice::make(surface.width, surface.height);
  if (!lattice.ok()) return lattice.status();
  const std::vector<double> gains = vertexGains(*lattice, surface);
  std::vector<VertexId> order = Decimator(*lattice, gains).run();
  return MeshSequence(std::move(*lattice), std::move(order), gains);
}

}  // namespace tetrakis
