// SPDX-License-Identifier: Apache-2.0
// flatten() lays the ring of a point in the plane, as MAPS does (Lee, Sweldens, Schröder, Cowsar,
// Dobkin 1998). The angles at the point are scaled until they fill the circle, or half of it at a
// boundary, and the radii are raised to a power that is the same scale. When the point is
// collapsed, the triangles before and after it tile the same flat polygon. That is the map between
// them.
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

/// Sets flat[i] to the place of point i of the ring. The centre is at the origin, no place is
/// farther from it than 1, and triangle 0 lies to the left of the line to point 0. Whatever the
/// points are, all flat triangles have an area.
void flatten(const std::vector<Point>& points, const Ring& ring, std::vector<FlatPoint>& flat);

/// Whether the flat triangles that are left when the centre moves to point `target` keep their
/// orientation and are not too thin for a map.
bool fansOut(const Ring& ring, const std::vector<FlatPoint>& flat, uint32_t target);

/// Whether triangle i of the ring vanishes when the centre moves to point `target`.
inline bool vanishes(const Ring& ring, uint32_t i, uint32_t target) {
  return i == target || ring.next(i) == target;
}

}  // namespace tetrakis::inline remesh
