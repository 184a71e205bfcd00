// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/quad_forest.hpp"

#include <algorithm>

#include "base/forest.hpp"
#include "bitstream/stream/glue.hpp"

namespace tetrakis::inline remesh {

namespace {

/// The two ends of a side, if corner 0 of the quad is the north-west corner of its patch. Side i
/// runs clockwise from corner i of the patch, which is corner -i of the quad (modulo 4).
std::array<uint32_t, 2> endsOf(const Quad& quad, uint32_t side) {
  return {quad.corners[(4 - side) % 4], quad.corners[3 - side]};
}

/// The number of a side after its ends, the lower one first.
struct Edge {
  uint32_t low, high, side;
  bool operator<(const Edge& other) const {
    return std::array{low, high, side} < std::array{other.low, other.high, other.side};
  }
};

/// For each side, 4 for each quad, the one that it is glued to, or Forest::kBorder.
std::vector<uint32_t> gluedSides(std::span<const Quad> quads) {
  std::vector<Edge> edges;
  std::vector<std::array<uint32_t, 2>> ends;
  for (const Quad& quad : quads) {
    for (uint32_t side = 0; side < Forest::kSides; ++side) {
      ends.push_back(endsOf(quad, side));
      const auto [a, b] = ends.back();
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<uint32_t>(edges.size())});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<uint32_t> sides(edges.size(), Forest::kBorder);
  for (size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next].low == edges[i].low &&
           edges[next].high == edges[i].high)
      ++next;
    const uint32_t a = edges[i].side, b = edges[next - 1].side;
    if (next != i + 2 || ends[a][0] != ends[b][1]) continue;
    sides[a] = b;
    sides[b] = a;
  }
  return sides;
}

}  // namespace

QuadForest quadForest(std::span<const Quad> quads) {
  const std::vector<uint32_t> given = gluedSides(quads);
  QuadForest forest{std::vector<uint32_t>(given.size(), Forest::kBorder), {}, {}};
  std::vector<uint32_t> number(given.size());  // the new number of each side
  for (const MetFace& met : facesAsMet(given, Forest::kSides)) {
    const auto patch = static_cast<uint32_t>(forest.quads.size());
    forest.quads.push_back(met.face);
    forest.first_corners.push_back(static_cast<uint8_t>((4 - met.entered) % 4));
    for (uint32_t i = 0; i < Forest::kSides; ++i)
      number[Forest::kSides * met.face + (met.entered + i) % 4] = Forest::kSides * patch + i;
  }
  for (size_t side = 0; side < given.size(); ++side)
    if (given[side] != Forest::kBorder) forest.sides[number[side]] = number[given[side]];
  return forest;
}

}  // namespace tetrakis::inline remesh
