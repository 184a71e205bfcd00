// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/study/study.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "codec/mesh/gains/gains.hpp"

namespace tetrakis::inline study {

std::vector<double> closureSlopes(const Lattice& lattice, std::span<const double> gains) {
  std::vector<VertexId> vertices(lattice.vertexCount());
  std::iota(vertices.begin(), vertices.end(), VertexId{0});
  return closureSlopes(lattice, vertices, gains);
}

MeshHull::MeshHull(const Lattice& lattice, const std::vector<double>& gains,
                   const std::vector<double>& slopes) {
  assert(gains.size() == lattice.vertexCount() && slopes.size() == gains.size());
  std::vector<VertexId> order(gains.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  std::sort(order.begin(), order.end(),
            [&](VertexId v, VertexId w) { return slopes[v] > slopes[w]; });
  Corner corner{2 * lattice.rootColumns() * lattice.rootRows(),
                std::accumulate(gains.begin(), gains.end(), 0.0)};
  corners_.push_back(corner);
  for (size_t i = 0; i < order.size(); ++i) {
    corner.triangles += lattice.triangleCost(lattice.site(order[i]));
    corner.squared_error -= gains[order[i]];
    const bool last = i + 1 == order.size() || slopes[order[i]] != slopes[order[i + 1]];
    if (!last) continue;
    if (corner.triangles == corners_.back().triangles)
      corners_.back().squared_error = std::min(corners_.back().squared_error, corner.squared_error);
    else
      corners_.push_back(corner);
  }
}

double MeshHull::bound(uint32_t triangles) const {
  assert(triangles >= corners_.front().triangles);
  const auto after = std::upper_bound(
      corners_.begin(), corners_.end(), triangles,
      [](uint32_t count, const Corner& corner) { return count < corner.triangles; });
  const Corner& before = *(after - 1);
  if (after == corners_.end()) return before.squared_error;
  const double share = static_cast<double>(triangles - before.triangles) /
                       static_cast<double>(after->triangles - before.triangles);
  return before.squared_error + share * (after->squared_error - before.squared_error);
}

Result<MeshSequence> decimateOptimally(const SurfaceView& surface) {
  Result<MeshSequence> greedy = decimate(surface);
  if (!greedy.ok()) return greedy;
  const Lattice& lattice = greedy->lattice();
  const std::vector<double> gains = vertexGains(lattice, surface);
  std::vector<VertexId> order = greedy->order();
  sortThroughCorners(lattice, gains, order);
  return MeshSequence(lattice, std::move(order), gains);
}

}  // namespace tetrakis::inline study
