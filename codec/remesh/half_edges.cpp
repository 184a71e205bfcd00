// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/half_edges.hpp"

#include <algorithm>

namespace tetrakis::inline remesh {

namespace {

/// A half-edge, and the higher one of its ends.
struct SideTo {
  uint32_t high = 0, side = 0;

  bool operator<(const SideTo& other) const {
    return high != other.high ? high < other.high : side < other.side;
  }
};

uint32_t lowEnd(std::span<const Triangle> triangles, uint32_t side) {
  return std::min(startOf(triangles, side), startOf(triangles, nextSide(side)));
}
uint32_t highEnd(std::span<const Triangle> triangles, uint32_t side) {
  return std::max(startOf(triangles, side), startOf(triangles, nextSide(side)));
}

/// For each point the place of its first half-edge in a list by lower ends, and the end of all.
std::vector<uint32_t> firstPlaces(std::span<const Triangle> triangles, uint32_t sides) {
  uint32_t points = 0;
  for (const Triangle& t : triangles) points = std::max({points, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<uint32_t> first(size_t{points} + 1);
  for (uint32_t side = 0; side < sides; ++side) ++first[lowEnd(triangles, side) + 1];
  for (size_t point = 1; point < first.size(); ++point) first[point] += first[point - 1];
  return first;
}

/// Glues half-edges with one lower end, which are sorted.
void glue(std::span<const SideTo> sides, GluedSides& glued) {
  for (size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].high == sides[first].high) ++end;
    ++glued.edges;
    if (end - first > 2) ++glued.crowded;
    if (end - first != 2) continue;
    glued.opposite[sides[first].side] = sides[first + 1].side;
    glued.opposite[sides[first + 1].side] = sides[first].side;
  }
}

}  // namespace

GluedSides gluedSides(std::span<const Triangle> triangles) {
  const auto sides = static_cast<uint32_t>(3 * triangles.size());
  const std::vector<uint32_t> first = firstPlaces(triangles, sides);
  std::vector<SideTo> by_ends(sides);
  std::vector<uint32_t> next = first;
  for (uint32_t side = 0; side < sides; ++side)
    by_ends[next[lowEnd(triangles, side)]++] = {highEnd(triangles, side), side};
  GluedSides glued;
  glued.opposite.assign(sides, kNone);
  for (size_t point = 0; point + 1 < first.size(); ++point) {
    const auto of_point = std::span(by_ends).subspan(first[point], first[point + 1] - first[point]);
    std::sort(of_point.begin(), of_point.end());
    glue(of_point, glued);
  }
  return glued;
}

}  // namespace tetrakis::inline remesh
