// SPDX-License-Identifier: Apache-2.0
// TriangleMesh is a mesh as files hold it, and SurfacePoint a place on it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tetrakis::inline remesh {

using Point = std::array<double, 3>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) {
  return std::sqrt(dot(a, a));
}

inline constexpr uint32_t kNone = UINT32_MAX;  ///< no point, no triangle, no side

using Triangle = std::array<uint32_t, 3>;  ///< numbers of points, counter-clockwise from outside

struct TriangleMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

/// A place in a triangle of a mesh, by what its three corners weigh: not negative, 1 in all.
struct SurfacePoint {
  uint32_t triangle = 0;
  std::array<double, 3> weights{1, 0, 0};
};

/// The longest straight line in the box that holds all points: what errors are compared with.
double diagonal(const TriangleMesh& mesh);

/// Normal of a triangle; as long as twice its area.
inline Point areaNormal(const TriangleMesh& mesh, const Triangle& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

inline Point at(const TriangleMesh& mesh, const SurfacePoint& place) {
  const Triangle& t = mesh.triangles[place.triangle];
  return place.weights[0] * mesh.points[t[0]] + place.weights[1] * mesh.points[t[1]] +
         place.weights[2] * mesh.points[t[2]];
}

}  // namespace tetrakis::inline remesh
