// SPDX-License-Identifier: Apache-2.0
// Topological orders of the parent relation, greedily from below or from above.
#include "codec/mesh/study/leaf_order.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <queue>

#include "codec/mesh/decimation/slope_queue.hpp"
#include "codec/mesh/decimation/worth.hpp"

namespace tetrakis::inline study {
namespace {

using Ready = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

/// Vertices that wait for nobody, least first. candidate(Site, VertexId) -> Candidate;
/// forEachBlocker(Site, visit) visits whom a vertex waits for, forEachBlocked who waits for it.
template <class MakeCandidate, class ForEachBlocker, class ForEachBlocked>
std::vector<VertexId> greedyOrder(const Lattice& lattice, MakeCandidate&& candidate,
                                  ForEachBlocker&& forEachBlocker,
                                  ForEachBlocked&& forEachBlocked) {
  std::vector<uint8_t> blockers(lattice.vertexCount());
  Ready ready;
  lattice.forEachVertex([&](Site site, VertexId v) {
    forEachBlocker(site, [&](Site) { ++blockers[v]; });
    if (blockers[v] == 0) ready.push(candidate(site, v));
  });
  std::vector<VertexId> order;
  order.reserve(blockers.size());
  while (!ready.empty()) {
    const VertexId v = ready.top().vertex;
    ready.pop();
    order.push_back(v);
    forEachBlocked(lattice.site(v), [&](Site blocked) {
      const VertexId id = lattice.id(blocked);
      if (--blockers[id] == 0) ready.push(candidate(blocked, id));
    });
  }
  assert(order.size() == blockers.size());  // no vertex waits for ever
  return order;
}

}  // namespace

std::vector<VertexId> restrictedDecimation(const std::vector<double>& errors,
                                           const VertexCosts& costs) {
  const Lattice& lattice = costs.lattice();
  std::vector<VertexId> order = greedyOrder(
      lattice,
      [&](Site site, VertexId v) {
        return Candidate{slopeOf(errors[v], costs.of(site, v)), v};
      },
      [&](Site site, auto&& visit) { lattice.forEachChild(site, visit); },
      [&](Site site, auto&& visit) { lattice.forEachParent(site, visit); });
  std::reverse(order.begin(), order.end());
  return order;
}

std::vector<VertexId> refinement(const std::vector<double>& errors, const VertexCosts& costs) {
  const Lattice& lattice = costs.lattice();
  return greedyOrder(
      lattice,
      [&](Site site, VertexId v) {
        const uint32_t cost = costs.of(site, v);
        return Candidate{
            cost == 0 ? -std::numeric_limits<double>::infinity() : -slopeOf(errors[v], cost), v};
      },
      [&](Site site, auto&& visit) { lattice.forEachParent(site, visit); },
      [&](Site site, auto&& visit) { lattice.forEachChild(site, visit); });
}

}  // namespace tetrakis::inline study
