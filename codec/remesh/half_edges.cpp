// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/half_edges.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline remesh {

GluedSides gluedSides(std::span<const Triangle> triangles) {
  const auto sides = static_cast<uint32_t>(3 * triangles.size());
  std::vector<std::pair<uint64_t, uint32_t>> by_ends(sides);
  for (uint32_t side = 0; side < sides; ++side) {
    const auto [low, high] =
        std::minmax({startOf(triangles, side), startOf(triangles, nextSide(side))});
    by_ends[side] = {uint64_t{low} << 32 | high, side};
  }
  std::sort(by_ends.begin(), by_ends.end());
  GluedSides glued;
  glued.opposite.assign(sides, kNone);
  for (size_t first = 0, end = 0; first < sides; first = end) {
    while (end < sides && by_ends[end].first == by_ends[first].first) ++end;
    ++glued.edges;
    if (end - first > 2) ++glued.crowded;
    if (end - first != 2) continue;
    glued.opposite[by_ends[first].second] = by_ends[first + 1].second;
    glued.opposite[by_ends[first + 1].second] = by_ends[first].second;
  }
  return glued;
}

}  // namespace tetrakis::inline remesh
