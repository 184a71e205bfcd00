// SPDX-License-Identifier: Apache-2.0
// TriangleMesh is a mesh as files hold it, SurfacePoint is a place on it, and Box bounds points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tetrakis::inline remesh {

using Point = Vec3;
using base::cross, base::dot, base::length;

inline Point operator+(const Point& a, const Point& b) {
  return add(a, b);
}
inline Point operator-(const Point& a, const Point& b) {
  return subtract(a, b);
}
inline Point operator*(double s, const Point& a) {
  return scale(a, s);
}

inline constexpr uint32_t kNone = UINT32_MAX;  ///< no point, no triangle, no side

using Triangle = std::array<uint32_t, 3>;  ///< numbers of points, counter-clockwise from outside

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

/// A place in a triangle of a mesh. It is the mean of the three corners by these weights, none of
/// which is negative, and whose sum is 1.
struct SurfacePoint {
  uint32_t triangle = 0;
  std::array<double, 3> weights{1, 0, 0};
};

/// The smallest box with sides along the axes that holds what was added to it. A new box is empty:
/// its lower ends lie above its higher ones.
struct Box {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  void add(const Box& other) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};

inline Box boxAround(std::span<const Point> points) {
  Box box;
  for (const Point& point : points) box.add({point, point});
  return box;
}

/// The diagonal of the box around all points, which errors are compared with; 0 without points.
inline double diagonal(const TriangleMesh& mesh) {
  const Box box = boxAround(mesh.points);
  return mesh.points.empty() ? 0 : length(box.high - box.low);
}

/// The normal of a triangle. Its length is twice the area of the triangle.
inline Point areaNormal(const TriangleMesh& mesh, const Triangle& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

/// Where a place of the mesh lies in space.
inline Point at(const TriangleMesh& mesh, const SurfacePoint& place) {
  const Triangle& t = mesh.triangles[place.triangle];
  return place.weights[0] * mesh.points[t[0]] + place.weights[1] * mesh.points[t[1]] +
         place.weights[2] * mesh.points[t[2]];
}

}  // namespace tetrakis::inline remesh
