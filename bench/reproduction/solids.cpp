// SPDX-License-Identifier: Apache-2.0
#include "bench/reproduction/solids.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "codec/mesh/study/forest_quadtree.hpp"

namespace tetrakis::bench {

namespace {

Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Point operator*(double k, const Point& a) {
  return {k * a.x, k * a.y, k * a.z};
}

/// The patch with other corners first.
SolidPatch started(const SolidPatch& patch, uint32_t corner) {
  SolidPatch turned = patch;
  for (uint32_t i = 0; i < 4; ++i) turned.corners[i] = patch.corners[(i + corner) % 4];
  return turned;
}

}  // namespace

Solid tetrahedron() {
  return {"tetrahedron",
          {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
          {{{0, 2, 1, 3}, {}}, {{2, 0, 3, 1}, {}}}};
}

Solid octahedron() {
  return {"octahedron",
          {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
          {{{0, 3, 2, 1}, Point{0, 0, 1}}, {{2, 3, 0, 1}, Point{0, 0, -1}}}};
}

Solid icosahedron() {
  Solid solid{"icosahedron", {{0, 0, 1}, {0, 0, -1}}, {}};
  const double height = 1 / std::sqrt(5.0), radius = 2 / std::sqrt(5.0);
  for (uint32_t i = 0; i < 10; ++i) {  // 2 + 2 i above, 3 + 2 i below the equator
    const double angle = i * std::numbers::pi / 5;
    solid.corners.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), i % 2 == 0 ? height : -height});
  }
  for (uint32_t i = 0; i < 10; i += 2) {
    const uint32_t a = 2 + i, b = 3 + i, c = 2 + (i + 2) % 10, d = 2 + (i + 3) % 10;
    solid.patches.push_back({{a, 0, c, b}, {}});
    solid.patches.push_back({{b, c, d, 1}, {}});
  }
  return solid;
}

Solid tetrakisHexahedron() {
  Solid solid{"tetrakishexahedron", {}, {}};
  for (uint32_t i = 0; i < 8; ++i)
    solid.corners.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  // Four faces go eastwards round the z axis, each with its west at the east of the one before.
  solid.patches = {{{5, 7, 3, 1}, Point{1.5, 0, 0}},  {{7, 6, 2, 3}, Point{0, 1.5, 0}},
                   {{6, 4, 0, 2}, Point{-1.5, 0, 0}}, {{4, 5, 1, 0}, Point{0, -1.5, 0}},
                   {{4, 6, 7, 5}, Point{0, 0, 1.5}},  {{1, 3, 2, 0}, Point{0, 0, -1.5}}};
  return solid;
}

std::vector<uint32_t> sidesOf(const Solid& solid) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> open;
  std::vector<uint32_t> sides(solid.patches.size() * Forest::kSides, Forest::kBorder);
  for (uint32_t side = 0; side < sides.size(); ++side) {
    const std::array<uint32_t, 4>& corners = solid.patches[side / 4].corners;
    const uint32_t a = corners[side % 4], b = corners[(side + 1) % 4];
    open[{a, b}] = side;
    const auto other = open.find({b, a});  // clockwise round both patches
    if (other == open.end()) continue;
    sides[side] = other->second;
    sides[other->second] = side;
  }
  return sides;
}

Point pointOf(const Solid& solid, uint32_t patch, double x, double y) {
  const SolidPatch& p = solid.patches[patch];
  const auto corner = [&](uint32_t i) { return solid.corners[p.corners[i % 4]]; };
  if (!p.middle) {
    const Point& nw = solid.corners[p.corners[0]];
    const Point& se = solid.corners[p.corners[2]];
    return x >= y ? nw + x * (corner(1) - nw) + y * (se - corner(1))
                  : nw + y * (corner(3) - nw) + x * (se - corner(3));
  }
  const double right = x - 0.5, down = y - 0.5;
  const double out[] = {-down, right, down, -right}, along[] = {right, down, -right, -down};
  uint32_t side = 0;
  for (uint32_t i = 1; i < 4; ++i)
    if (out[i] > out[side]) side = i;
  const Point a = corner(side), b = corner(side + 1);
  return *p.middle + out[side] * (a + b - 2 * *p.middle) + along[side] * (b - a);
}

Point onSphere(const Point& p) {
  return 1 / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) * p;
}

uint32_t turnedPairs(const std::vector<uint32_t>& sides) {
  uint32_t turned = 0;
  for (uint32_t side = 0; side < sides.size(); ++side)
    turned += side < sides[side] && (side + 2) % 4 != sides[side] % 4 ? 1 : 0;
  return turned;
}

Layouts layoutsOf(const Solid& solid) {
  Layouts found;
  Solid laid = solid;
  std::vector<uint32_t> starts(solid.patches.size());
  const auto next = [&] {  // counts in `starts`
    for (size_t p = 0; p < starts.size(); ++p) {
      starts[p] = (starts[p] + (solid.patches[p].middle ? 1 : 2)) % 4;
      laid.patches[p] = started(solid.patches[p], starts[p]);
      if (starts[p] != 0) return true;
    }
    return false;
  };
  do {
    const std::vector<uint32_t> sides = sidesOf(laid);
    const uint32_t turned = turnedPairs(sides);
    const uint32_t trees = borderTrees(ForestAdjacency(Forest(1, sides)));
    ++found.count;
    found.least_turned = std::min(found.least_turned, turned);
    if (std::pair(trees, turned) >= std::pair(found.least_border_trees, found.turned_without_trees))
      continue;
    found.least_border_trees = trees;
    found.turned_without_trees = turned;
    found.sides = sides;
  } while (next());
  return found;
}

}  // namespace tetrakis::bench
