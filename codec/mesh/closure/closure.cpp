// SPDX-License-Identifier: Apache-2.0
// Isotonic regression by divide and conquer over slopes, in integers.
#include "codec/mesh/closure/closure.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tetrakis::inline closure {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// floor(a / b), b > 0.
int64_t floorDivide(int64_t a, int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// Parents as positions in `vertices`.
std::vector<ClosureFlow::Arcs> parentArcs(const Lattice& lattice,
                                          std::span<const VertexId> vertices) {
  std::vector<uint32_t> position(lattice.vertexCount(), ClosureFlow::kNone);
  std::vector<ClosureFlow::Arcs> arcs;
  arcs.reserve(vertices.size());
  for (const VertexId v : vertices) {
    position[v] = static_cast<uint32_t>(arcs.size());
    ClosureFlow::Arcs parents{ClosureFlow::kNone, ClosureFlow::kNone};
    size_t slot = 0;
    lattice.forEachParent(lattice.site(v), [&](Site parent) {
      parents[slot++] = position[lattice.id(parent)];
      assert(parents[slot - 1] != ClosureFlow::kNone);
    });
    arcs.push_back(parents);
  }
  return arcs;
}

class Regression {
 public:
  Regression(std::vector<ClosureFlow::Arcs> parents, std::vector<uint8_t> costs,
             std::span<const double> gains)
      : parents_(parents),
        gains_(gains.size()),
        costs_(std::move(costs)),
        slopes_(gains.size()),
        order_(gains.size()),
        flow_(std::move(parents)) {
    scaleGains(gains);
    std::iota(order_.begin(), order_.end(), 0u);
  }

  /// Halves what holds the hull at `triangles` beyond the roots, and nothing else.
  std::vector<double> sidesOf(int64_t triangles) {
    std::vector<double> sides(order_.size(), hull_side::kAcross);
    std::span<uint32_t> members = order_;
    for (bool at_mean = false; !members.empty();) {
      const Sums sums = sumsOf(members);
      at_mean |= members.size() < kFewVertices;
      const bool whole = sums.cost == 0 || !cut(members, at_mean ? floorDivide(sums.gain, sums.cost)
                                                                 : medianSlope(members));
      if (whole && sums.cost > 0 && !std::exchange(at_mean, true)) continue;
      if (whole) {  // from one corner to the next
        if (sums.cost <= triangles)
          for (const uint32_t v : members) sides[v] = hull_side::kWithin;
        break;
      }
      flow_.split(members);
      const auto rest = std::stable_partition(members.begin(), members.end(),
                                              [&](uint32_t v) { return flow_.inClosure(v); });
      const auto inside = members.first(static_cast<size_t>(rest - members.begin()));
      const auto outside = members.subspan(inside.size());
      const int64_t cost = sumsOf(inside).cost;
      const bool fits = cost <= triangles;
      if (fits) triangles -= cost;
      for (const uint32_t v : fits ? inside : outside)
        sides[v] = fits ? hull_side::kWithin : hull_side::kBeyond;
      members = fits ? outside : inside;
      at_mean = false;
    }
    return sides;
  }

  std::vector<double> run() {
    if (!order_.empty()) open_.push_back({0, order_.size(), order_.size() < kFewVertices});
    while (!open_.empty()) {
      const Part part = open_.back();
      open_.pop_back();
      settle(part);
    }
    keepOrder();
    return std::move(slopes_);
  }

 private:
  /// order_[begin, end).
  struct Part {
    size_t begin, end;
    bool at_mean;  ///< try its mean slope; else the median of its vertices, which halves better
  };
  struct Sums {
    int64_t gain = 0, cost = 0;
  };
  static constexpr size_t kFewVertices = 256;

  /// Doubles to integers whose absolute sum is below 2^58; that of any weights is then below 2^61.
  void scaleGains(std::span<const double> gains) {
    double total = 0;
    for (const double g : gains) total += std::abs(g);
    const int exponent = total > 0 ? 57 - std::ilogb(total) : 0;
    for (size_t i = 0; i < gains.size(); ++i)
      gains_[i] = static_cast<int64_t>(std::ldexp(gains[i], exponent));
    unit_ = std::ldexp(1.0, -exponent);
  }

  std::span<uint32_t> vertices(const Part& part) {
    return std::span(order_).subspan(part.begin, part.end - part.begin);
  }

  void settle(const Part& part) {
    const std::span<uint32_t> members = vertices(part);
    const Sums sums = sumsOf(members);
    if (members.size() == 1 || sums.cost == 0) {
      if (sums.cost == 0 && members.size() > 1) return settleWithoutCost(part);
      return finish(members, sums);
    }
    const int64_t slope = part.at_mean ? floorDivide(sums.gain, sums.cost) : medianSlope(members);
    if (cut(members, slope))
      openParts(part);
    else if (part.at_mean)
      finish(members, sums);
    else
      open_.push_back({part.begin, part.end, true});
  }

  /// Vertices that cost no triangles: worth having, or not.
  void settleWithoutCost(const Part& part) {
    const std::span<uint32_t> members = vertices(part);
    cut(members, 0);
    for (const uint32_t v : members) slopes_[v] = flow_.inClosure(v) ? kInfinity : -kInfinity;
  }

  /// Whether the maximum closure at this slope is neither empty nor all.
  bool cut(std::span<const uint32_t> members, int64_t slope) {
    weights_.resize(members.size());
    for (size_t i = 0; i < members.size(); ++i)
      weights_[i] = gains_[members[i]] - slope * costs_[members[i]];
    flow_.solve(members, weights_);
    const auto inside = std::count_if(members.begin(), members.end(),
                                      [&](uint32_t v) { return flow_.inClosure(v); });
    return inside > 0 && static_cast<size_t>(inside) < members.size();
  }

  void openParts(const Part& part) {
    size_t begin = part.begin;
    for (const size_t end : flow_.split(vertices(part))) {
      open_.push_back({begin, part.begin + end, part.begin + end - begin < kFewVertices});
      begin = part.begin + end;
    }
  }

  void finish(std::span<const uint32_t> members, const Sums& sums) {
    double slope = sums.gain > 0 ? kInfinity : -kInfinity;
    if (sums.cost > 0)
      slope = static_cast<double>(sums.gain) * unit_ / static_cast<double>(sums.cost);
    for (const uint32_t v : members) slopes_[v] = slope;
  }

  Sums sumsOf(std::span<const uint32_t> members) const {
    Sums sums;
    for (const uint32_t v : members) {
      sums.gain += gains_[v];
      sums.cost += costs_[v];
    }
    return sums;
  }

  /// The median of the vertices' own slopes, estimated from a sample of them, which is enough.
  int64_t medianSlope(std::span<const uint32_t> members) {
    constexpr size_t kSample = 4096;
    const size_t stride = members.size() / kSample + 1;
    weights_.clear();
    for (size_t i = 0; i < members.size(); i += stride)
      if (const uint8_t cost = costs_[members[i]]; cost > 0)
        weights_.push_back(floorDivide(gains_[members[i]], cost));
    if (weights_.empty()) return 0;
    const auto middle = weights_.begin() + static_cast<ptrdiff_t>(weights_.size() / 2);
    std::nth_element(weights_.begin(), middle, weights_.end());
    return *middle;
  }

  /// Parts that tie, or cost nothing, may stand above a parent's part: no vertex goes before its
  /// parents.
  void keepOrder() {
    for (size_t v = 0; v < slopes_.size(); ++v)
      for (const uint32_t parent : parents_[v])
        if (parent != ClosureFlow::kNone) slopes_[v] = std::min(slopes_[v], slopes_[parent]);
  }

  const std::vector<ClosureFlow::Arcs> parents_;
  std::vector<int64_t> gains_;  ///< in units
  double unit_ = 1;
  std::vector<uint8_t> costs_;
  std::vector<double> slopes_;
  std::vector<uint32_t> order_;  ///< parts are contiguous
  ClosureFlow flow_;
  std::vector<Part> open_;
  std::vector<int64_t> weights_;
};

}  // namespace

namespace {

Regression regressionOf(const Lattice& lattice, std::span<const VertexId> vertices,
                        std::span<const double> gains) {
  assert(gains.size() == vertices.size());
  std::vector<uint8_t> costs;
  costs.reserve(vertices.size());
  for (const VertexId v : vertices)
    costs.push_back(static_cast<uint8_t>(lattice.triangleCost(lattice.site(v))));
  return Regression(parentArcs(lattice, vertices), std::move(costs), gains);
}

}  // namespace

std::vector<double> closureSlopes(const Lattice& lattice, std::span<const VertexId> vertices,
                                  std::span<const double> gains) {
  return regressionOf(lattice, vertices, gains).run();
}

std::vector<double> hullSides(const Lattice& lattice, std::span<const VertexId> vertices,
                              std::span<const double> gains, uint32_t triangles) {
  const int64_t roots = int64_t{2} * lattice.rootColumns() * lattice.rootRows();
  return regressionOf(lattice, vertices, gains).sidesOf(triangles - roots);
}

std::vector<double> hullSides(ClosureGraph graph, std::span<const double> gains,
                              int64_t triangles) {
  assert(gains.size() == graph.parents.size() && gains.size() == graph.costs.size());
  return Regression(std::move(graph.parents), std::move(graph.costs), gains).sidesOf(triangles);
}

std::vector<VertexId> ascending(std::span<const VertexId> order) {
  if (order.empty()) return {};
  std::vector<bool> present(*std::max_element(order.begin(), order.end()) + 1);
  for (const VertexId v : order) present[v] = true;
  std::vector<VertexId> vertices;
  vertices.reserve(order.size());
  for (VertexId v = 0; v < present.size(); ++v)
    if (present[v]) vertices.push_back(v);
  return vertices;
}

void sortByKeys(std::span<const VertexId> vertices, std::span<const double> keys,
                std::span<VertexId> order) {
  assert(keys.size() == vertices.size() && order.size() == vertices.size());
  if (vertices.empty()) return;
  std::vector<double> key_of(vertices.back() + 1);
  for (size_t i = 0; i < vertices.size(); ++i) key_of[vertices[i]] = keys[i];
  struct Ranked {
    double key;
    uint32_t place;
    VertexId vertex;
  };
  std::vector<Ranked> ranked;
  ranked.reserve(order.size());
  for (const VertexId v : order)
    ranked.push_back({key_of[v], static_cast<uint32_t>(ranked.size()), v});
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.key != b.key ? a.key > b.key : a.place < b.place;
  });
  std::transform(ranked.begin(), ranked.end(), order.begin(),
                 [](const Ranked& r) { return r.vertex; });
}

void sortThroughCorners(const Lattice& lattice, const std::vector<double>& gains,
                        std::span<VertexId> order) {
  const std::vector<VertexId> vertices = ascending(order);
  std::vector<double> own;
  own.reserve(vertices.size());
  for (const VertexId v : vertices) own.push_back(gains[v]);
  sortByKeys(vertices, closureSlopes(lattice, vertices, own), order);
}

}  // namespace tetrakis::inline closure
