// SPDX-License-Identifier: Apache-2.0
// Solids of square patches for figures 3.3, 4.8 and 4.9 of the thesis: their corners in space, how
// their sides are glued, and where a point of a patch lies.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::bench {

struct Point {
  double x = 0, y = 0, z = 0;
};

/// Four corners nw, ne, se, sw, clockwise seen from outside. A patch is two triangles that meet
/// along its diagonal from nw to se, or four round its middle.
struct SolidPatch {
  std::array<uint32_t, 4> corners;
  std::optional<Point> middle;
};

struct Solid {
  std::string name;
  std::vector<Point> corners;
  std::vector<SolidPatch> patches;
};

Solid tetrahedron();
/// Two hemispheres with a pole in their middles.
Solid octahedron();
/// Ten pairs of triangles.
Solid icosahedron();
/// A cube of six patches, whose middles are raised by a quarter of a side.
Solid tetrakisHexahedron();

/// What the sides of patches are glued to, as Forest has it. Every edge has two patches.
std::vector<uint32_t> sidesOf(const Solid& solid);
/// The point at x, y of a patch, 0 to 1 from nw to ne and to sw.
Point pointOf(const Solid& solid, uint32_t patch, double x, double y);
/// The point of the unit sphere in the same direction.
Point onSphere(const Point& point);

/// Pairs that are neither a north and a south nor an east and a west: what is ahead of a path turns
/// there (thesis 4.6).
uint32_t turnedPairs(const std::vector<uint32_t>& sides);

/// Ways to lay the patches of a solid. Their north-west is any corner, or, where they have a
/// diagonal, either of its ends.
struct Layouts {
  uint64_t count = 0;
  uint32_t least_turned = UINT32_MAX;          ///< pairs, of all layouts
  uint32_t least_border_trees = UINT32_MAX;    ///< of all layouts
  uint32_t turned_without_trees = UINT32_MAX;  ///< the least of layouts with least_border_trees
  std::vector<uint32_t> sides;                 ///< of a layout that has both
};
Layouts layoutsOf(const Solid& solid);

}  // namespace tetrakis::bench
