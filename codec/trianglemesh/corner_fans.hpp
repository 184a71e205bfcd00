// SPDX-License-Identifier: Apache-2.0
// The corners of triangles that meet in a point are a fan. cornerFans() numbers the fans of a mesh
// in the order of their lowest corners, and visitFan() goes round one.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/trianglemesh/coded_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// Calls visit(corner) with each corner of a fan once. sides: as of CodedTriangles; a fan ends at
/// borders.
template <class Visit>
void visitFan(const std::vector<uint32_t>& sides, uint32_t corner, Visit&& visit) {
  visit(corner);
  uint32_t at = corner;
  while (sides[at] != kBorder) {
    at = after(sides[at]);
    if (at == corner) return;
    visit(at);
  }
  for (at = sides[before(corner)]; at != kBorder; at = sides[before(at)]) visit(at);
}

struct CornerFans {
  std::vector<uint32_t> of_corner;  ///< number of the fan
  std::vector<uint32_t> first;      ///< lowest corner of each fan
};

inline CornerFans cornerFans(const std::vector<uint32_t>& sides) {
  CornerFans fans{std::vector<uint32_t>(sides.size(), UINT32_MAX), {}};
  for (uint32_t corner = 0; corner < sides.size(); ++corner) {
    if (fans.of_corner[corner] != UINT32_MAX) continue;
    const auto number = static_cast<uint32_t>(fans.first.size());
    visitFan(sides, corner, [&](uint32_t met) { fans.of_corner[met] = number; });
    fans.first.push_back(corner);
  }
  return fans;
}

}  // namespace tetrakis::inline trianglemesh
