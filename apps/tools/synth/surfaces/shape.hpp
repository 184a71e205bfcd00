// SPDX-License-Identifier: Apache-2.0
// Shape is a mesh before it has a texture, and blob(), knot() and scan() make one.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tetrakis::tools::synth {

using Spot = std::array<double, 3>;

inline Spot operator+(const Spot& a, const Spot& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Spot operator-(const Spot& a, const Spot& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Spot operator*(double s, const Spot& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Spot& a, const Spot& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Spot cross(const Spot& a, const Spot& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Spot& a) {
  return std::sqrt(dot(a, a));
}
/// (1, 0, 0) where there is no direction.
inline Spot directionOf(const Spot& a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : Spot{1, 0, 0};
}

using Corners = std::array<uint32_t, 3>;  ///< numbers of points, counter-clockwise from outside

struct Shape {
  std::vector<Spot> points;
  std::vector<Corners> triangles;

  /// As long as twice the area.
  Spot normal(const Corners& t) const {
    return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
  }
};

/// About so many triangles; about two units across.
Shape blob(uint32_t triangles, uint64_t seed);
Shape knot(uint32_t triangles, uint64_t seed);
Shape scan(uint32_t triangles, uint64_t seed);

}  // namespace tetrakis::tools::synth
