// SPDX-License-Identifier: Apache-2.0
// The functions here compute with vectors in space, for cameras and the renderer.
#pragma once

#include <array>
#include <cmath>

namespace tetrakis::inline ground {

using Vec3 = std::array<double, 3>;

inline Vec3 add(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 subtract(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 scale(const Vec3& a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}
/// The zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? scale(a, 1 / l) : a;
}

/// Orthonormal axes of a view: to the right, up in the picture, into the picture.
struct ViewAxes {
  Vec3 right, up, forward;
};

inline ViewAxes viewAxes(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 forward = normalized(subtract(target, eye));
  const Vec3 right = normalized(cross(forward, up));
  return {right, cross(right, forward), forward};
}

}  // namespace tetrakis::inline ground
