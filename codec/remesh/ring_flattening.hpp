// SPDX-License-Identifier: Apache-2.0
// The ring of a point in the plane, as MAPS has it (Lee, Sweldens, Schröder, Cowsar, Dobkin 1998):
// angles are scaled so that they fill the circle, or half of it at a boundary, and radii are taken
// to the same power. When the point is collapsed, the triangles before and after tile the same
// polygon, and this is the map from the ones to the others.
#pragma once

#include <vector>

#include "codec/remesh/shrinking_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct FlatPoint {
  double x = 0, y = 0;
};

/// Twice the area of the triangle between the origin and two points; positive if b lies to the
/// left of a.
inline double cross(const FlatPoint& a, const FlatPoint& b) {
  return a.x * b.y - a.y * b.x;
}
inline FlatPoint operator-(const FlatPoint& a, const FlatPoint& b) {
  return {a.x - b.x, a.y - b.y};
}

/// Places of the ring's points, with its centre at the origin and its first triangle to the left of
/// its first point; at most 1 from it. Whatever the points are, all triangles have an area.
void flatten(const std::vector<Point>& points, const Ring& ring, std::vector<FlatPoint>& flat);

/// Whether the triangles that are left when the centre goes to point `target` are turned as before
/// and aren't too thin for a map.
bool fansOut(const Ring& ring, const std::vector<FlatPoint>& flat, uint32_t target);

/// Whether triangle i of the ring vanishes when the centre goes to point `target`.
inline bool vanishes(const Ring& ring, uint32_t i, uint32_t target) {
  return i == target || ring.next(i) == target;
}

}  // namespace tetrakis::inline remesh
