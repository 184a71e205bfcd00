// SPDX-License-Identifier: Apache-2.0
#include "codec/ground/box_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline ground {

namespace {

std::array<Vec3, 8> cornersOf(const Bounds& bounds) {
  std::array<Vec3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      corners[i][axis] = (i >> axis & 1u) ? bounds.high[axis] : bounds.low[axis];
  return corners;
}

/// Corners of a box as the points (u, f) = (sideways, forward) of one picture axis.
class BoxProfile {
 public:
  BoxProfile(const std::array<Vec3, 8>& corners, const Vec3& axis, const Vec3& forward) {
    for (size_t i = 0; i < corners.size(); ++i)
      points_[i] = {dot(corners[i], axis), dot(corners[i], forward)};
  }

  /// A point is seen from (eu, ef) with half angle atan(t) when |u - eu| <= t (f - ef), that is
  /// a <= eu - t ef and b <= -eu - t ef for the maxima a of u - t f and b of -u - t f. So the
  /// foremost eye that sees all has ef = -(a + b) / 2t.
  double foremost(double t) const {
    double a = -HUGE_VAL, b = -HUGE_VAL;
    for (const auto& [u, f] : points_) {
      a = std::max(a, u - t * f);
      b = std::max(b, -u - t * f);
    }
    return -(a + b) / (2 * t);
  }

  /// The eu from which, at ef, the picture leaves as much room on one side as on the other. Moving
  /// the eye sideways moves all points the other way, so bisection finds it.
  double centred(double ef) const {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& [u, f] : points_) {
      low = std::min(low, u);
      high = std::max(high, u);
    }
    for (int i = 0; i < 60; ++i) {
      const double eu = (low + high) / 2;
      double above = -HUGE_VAL, below = -HUGE_VAL;
      for (const auto& [u, f] : points_) {
        above = std::max(above, (u - eu) / (f - ef));
        below = std::max(below, (eu - u) / (f - ef));
      }
      (above > below ? low : high) = eu;
    }
    return (low + high) / 2;
  }

 private:
  std::array<std::pair<double, double>, 8> points_;
};

}  // namespace

HalfAngles halfAngles(const Camera& camera) {
  constexpr double kRadian = std::numbers::pi / 180;
  const double tan_y = portable::tan(camera.fov_y * kRadian / 2);
  return {tan_y * camera.width / camera.height, tan_y};
}

Camera seeingAll(Camera camera, const Bounds& bounds) {
  constexpr double kMargin = 0.97;  // share of the picture for the box
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const HalfAngles half = halfAngles(camera);
  const BoxProfile x(cornersOf(bounds), axes.right, axes.forward);
  const BoxProfile y(cornersOf(bounds), axes.up, axes.forward);
  const double forward =
      std::min(x.foremost(kMargin * half.tan_x), y.foremost(kMargin * half.tan_y));
  camera.eye = add(add(scale(axes.right, x.centred(forward)), scale(axes.up, y.centred(forward))),
                   scale(axes.forward, forward));
  const double depth = dot(centreOf(bounds), axes.forward) - forward;
  camera.target = add(camera.eye, scale(axes.forward, depth));
  return camera;
}

}  // namespace tetrakis::inline ground
