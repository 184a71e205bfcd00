// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/decimation/merging_domains.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline decimation {

// One pair of levels after the other gives its rows to all vertices above it.

namespace {

/// Vertices of a level in one row, and where they lie in units of the step of RowSums.
struct VertexRow {
  DomainWorth* domains;
  size_t count;
  int64_t left, stride, y;
};

/// Prefix sums along the rows of one pair of levels: columns and rows are multiples of its step.
class RowSums {
 public:
  RowSums(const std::vector<double>& gains, const VertexCosts& costs, uint32_t centres)
      : gains_(&gains),
        costs_(&costs),
        centres_(centres),
        columns_(costs.lattice().plan(centres + 1).columns),
        rows_(costs.lattice().plan(centres + 1).rows),
        sums_(size_t{rows_} * (columns_ + 1)) {
    for (uint32_t y = 0; y < rows_; ++y) addRow(y);
  }

  int64_t rows() const { return rows_; }
  /// Adds row y from x - reach to x + reach to the domain of the vertex at x.
  void addTo(const VertexRow& vertices, int64_t y, int64_t reach) const {
    const Worth* row = &sums_[static_cast<size_t>(y) * (columns_ + 1)];
    const int64_t end = columns_;
    DomainWorth* to = vertices.domains;
    int64_t x = vertices.left;
    for (size_t i = 0; i < vertices.count; ++i, ++to, x += vertices.stride) {
      *to += row[std::min(x + reach + 1, end)];
      *to -= row[std::max<int64_t>(x - reach, 0)];
    }
  }

 private:
  /// Midpoints have odd coordinate sums, centres two odd coordinates.
  void addRow(uint32_t y) {
    const Lattice& lattice = costs_->lattice();
    Worth* row = &sums_[size_t{y} * (columns_ + 1)];
    Worth sum;
    const auto add = [&](Site site) {
      const VertexId v = lattice.id(site);
      sum += {(*gains_)[v], costs_->of(site, v)};
    };
    for (uint32_t x = 0; x < columns_; ++x) {
      row[x] = sum;
      if ((x + y) % 2 == 1)
        add({centres_ + 1, x, y});
      else if (x % 2 == 1)
        add({centres_, x / 2, y / 2});
    }
    row[columns_] = sum;
  }

  const std::vector<double>* gains_;
  const VertexCosts* costs_;
  uint32_t centres_;  ///< the level
  uint32_t columns_, rows_;
  std::vector<Worth> sums_;
};

void addOctagons(const RowSums& sums, const VertexRow& row, const Octagon& octagon) {
  const int64_t top = std::max<int64_t>(row.y - octagon.x, 0);
  const int64_t bottom = std::min(row.y + octagon.x, sums.rows() - 1);
  for (int64_t y = top; y <= bottom; ++y) sums.addTo(row, y, octagon.reach(y - row.y));
}

/// Adds a pair of levels, 2^k times finer, to the domains of one of the levels above it or in it.
void addPair(const RowSums& sums, const Lattice& lattice, uint32_t level, uint32_t k,
             std::vector<DomainWorth>& domains) {
  const Lattice::Plan& plan = lattice.plan(level);
  const int64_t scale = int64_t{1} << k;
  const bool centre = Lattice::isCentre(level);
  const Octagon octagon = Octagon::ofMidpoints(level, k);
  DomainWorth* next = &domains[plan.first];
  for (uint32_t row = 0; row < plan.rows; ++row) {
    const uint32_t first = centre || row % 2 == 1 ? 0 : 1;
    const size_t count = centre ? plan.columns : (plan.columns + 1 - first) / 2;
    const int64_t left = centre ? scale : first * scale;
    const int64_t y = centre ? (2 * int64_t{row} + 1) * scale : row * scale;
    addOctagons(sums, {next, count, left, 2 * scale, y}, octagon);
    next += count;
  }
}

// completeDomains() sums the gains and costs of vertices over the complete merging domain of every
// vertex (thesis 3.3), with which decimation begins. A domain fills an octagon, and a sum over a
// row of it is a difference of two prefix sums.

/// Returns u(M_v) of every vertex v while no vertex is removed. gains: one for each vertex; their
/// sums are exact in any order (gains/gains.hpp).
std::vector<DomainWorth> completeDomains(const std::vector<double>& gains,
                                         const VertexCosts& costs) {
  const Lattice& lattice = costs.lattice();
  assert(gains.size() == lattice.vertexCount());
  std::vector<DomainWorth> domains(gains.size());
  for (uint32_t centres = 0; centres < lattice.levelCount(); centres += 2) {
    const RowSums sums(gains, costs, centres);
    for (uint32_t level = 0; level < centres + 2; ++level)
      addPair(sums, lattice, level, (centres - level / 2 * 2) / 2, domains);
  }
  return domains;
}

}  // namespace

// The vertices of a domain; domains of coarse vertices.

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
