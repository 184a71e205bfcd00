// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/decimation/saturated_order.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "codec/mesh/decimation/slope_queue.hpp"

namespace tetrakis::inline decimation {

std::vector<VertexId> saturatedOrder(const std::vector<double>& errors, const VertexCosts& costs,
                                     uint64_t most) {
  constexpr double kLeast = -std::numeric_limits<double>::infinity();
  const Lattice& lattice = costs.lattice();
  assert(errors.size() == lattice.vertexCount());
  std::vector<Candidate> order(errors.size());
  uint64_t free = 0;
  lattice.forEachVertex([&](Site site, VertexId v) {
    const uint32_t cost = costs.of(site, v);
    order[v] = {cost > 0 ? -errors[v] / cost : -kLeast, v};
    free += cost == 0;
  });
  for (VertexId v = lattice.vertexCount(); v-- > 0;)
    lattice.forEachParent(lattice.site(v), [&](Site parent) {
      double& slope = order[lattice.id(parent)].slope;
      slope = std::min(slope, order[v].slope);
    });
  const auto wanted = static_cast<size_t>(std::min<uint64_t>(order.size(), most + free));
  // By pointers, as std::sort does it: they share their code.
  std::nth_element(order.data(), order.data() + wanted, order.data() + order.size());
  order.resize(wanted);
  std::sort(order.begin(), order.end());
  std::vector<VertexId> vertices;
  vertices.reserve(order.size());
  for (const Candidate& candidate : order) vertices.push_back(candidate.vertex);
  return vertices;
}

}  // namespace tetrakis::inline decimation
