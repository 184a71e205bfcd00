// SPDX-License-Identifier: Apache-2.0
// Views of a terrain that need no file.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/render.hpp"
#include "tools/vec3.hpp"

namespace tetrakis::tools {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

struct HalfAngles {
  double tan_x, tan_y;
};

HalfAngles halfAngles(const Camera& camera) {
  const double tan_y = std::tan(camera.fov_y * kRadian / 2);
  return {tan_y * camera.width / camera.height, tan_y};
}

Vec3 centreOf(const Bounds& bounds) {
  return scale(add(bounds.low, bounds.high), 0.5);
}

std::array<Vec3, 8> cornersOf(const Bounds& bounds) {
  std::array<Vec3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      corners[i][axis] = (i >> axis & 1u) ? bounds.high[axis] : bounds.low[axis];
  return corners;
}

/// Along one picture axis with half angle atan(t), a point (u, f) = (sideways, forward) is seen
/// from (eu, ef) when |u - eu| <= t (f - ef), that is a <= eu - t ef and b <= -eu - t ef for the
/// maxima a of u - t f and b of -u - t f. The foremost such eye has ef = -(a + b) / 2t, eu = (a -
/// b) / 2; behind it the same eu stays centred.
struct Fit {
  double sideways, forward;
};

Fit fit(const std::array<Vec3, 8>& corners, const Vec3& axis, const Vec3& forward, double t) {
  double a = -HUGE_VAL, b = -HUGE_VAL;
  for (const Vec3& corner : corners) {
    const double u = dot(corner, axis), f = dot(corner, forward);
    a = std::max(a, u - t * f);
    b = std::max(b, -u - t * f);
  }
  return {(a - b) / 2, -(a + b) / (2 * t)};
}

/// Moves the camera, keeping its direction and its angle, to the nearest place that sees the whole
/// box with a small margin.
void frame(Camera& camera, const Bounds& bounds) {
  constexpr double kMargin = 0.97;  // share of the picture for the box
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const HalfAngles half = halfAngles(camera);
  const std::array<Vec3, 8> corners = cornersOf(bounds);
  const Fit x = fit(corners, axes.right, axes.forward, kMargin * half.tan_x);
  const Fit y = fit(corners, axes.up, axes.forward, kMargin * half.tan_y);
  const double forward = std::min(x.forward, y.forward);
  camera.eye = add(add(scale(axes.right, x.sideways), scale(axes.up, y.sideways)),
                   scale(axes.forward, forward));
  const double depth = dot(centreOf(bounds), axes.forward) - forward;
  camera.target = add(camera.eye, scale(axes.forward, depth));
}

Camera obliqueView(const Bounds& bounds) {
  constexpr double kElevation = 35 * kRadian;
  Camera camera;
  camera.name = "oblique";
  camera.target = centreOf(bounds);
  camera.eye = add(camera.target, Vec3{0, std::sin(kElevation), std::cos(kElevation)});
  frame(camera, bounds);
  return camera;
}

Camera topView(const Bounds& bounds) {
  Camera camera;
  camera.name = "top";
  camera.up = {0, 0, -1};
  camera.target = centreOf(bounds);
  camera.eye = add(camera.target, Vec3{0, 1, 0});
  frame(camera, bounds);
  return camera;
}

/// Share of the ground, taken as flat at middle height, that the camera sees.
double seenShare(const Camera& camera, const Bounds& bounds) {
  constexpr int kSteps = 64;
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const HalfAngles half = halfAngles(camera);
  const auto between = [&](size_t axis, int i) {
    return bounds.low[axis] + (bounds.high[axis] - bounds.low[axis]) * (i + 0.5) / kSteps;
  };
  int seen = 0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 ground{between(0, i), centreOf(bounds)[1], between(2, j)};
      const Vec3 ray = subtract(ground, camera.eye);
      const double depth = dot(ray, axes.forward);
      seen += std::abs(dot(ray, axes.right)) <= half.tan_x * depth &&
              std::abs(dot(ray, axes.up)) <= half.tan_y * depth;
    }
  }
  return static_cast<double>(seen) / (kSteps * kSteps);
}

/// Looks north from `distance` before the northern border, so that the border (at middle height)
/// lies four fifths up the picture: below it ground, above it the horizon.
Camera lowViewFrom(double distance, const Bounds& bounds) {
  const Vec3 centre = centreOf(bounds);
  const double extent = std::max(bounds.high[0] - bounds.low[0], bounds.high[2] - bounds.low[2]);
  Camera camera;
  camera.name = "low";
  const double clearance = 0.01 * extent;
  const double above_middle = bounds.high[1] - centre[1] + clearance;
  const double border_angle = std::atan(above_middle / distance);
  const double tan_half = halfAngles(camera).tan_y;
  const double pitch = std::min(border_angle + std::atan(0.6 * tan_half), 80 * kRadian);
  const double reach = above_middle / std::tan(pitch);
  camera.eye = {centre[0], centre[1] + above_middle, bounds.low[2] + distance};
  camera.target = {centre[0], centre[1], camera.eye[2] - reach};
  return camera;
}

Camera lowView(const Bounds& bounds) {
  constexpr double kShare = 0.1;
  const double depth = bounds.high[2] - bounds.low[2];
  double near = depth / 64, far = depth;
  for (int i = 0; i < 30; ++i) {
    const double middle = (near + far) / 2;
    const bool enough = seenShare(lowViewFrom(middle, bounds), bounds) >= kShare;
    (enough ? far : near) = middle;
  }
  return lowViewFrom(far, bounds);
}

/// A terrain without extent would leave the camera nowhere to stand.
Bounds withExtent(Bounds bounds) {
  for (const size_t axis : {0u, 2u}) {
    if (bounds.high[axis] > bounds.low[axis]) continue;
    bounds.low[axis] -= 0.5;
    bounds.high[axis] += 0.5;
  }
  return bounds;
}

}  // namespace

Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& given) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(given.low[axis]) || !std::isfinite(given.high[axis]))
      return Status(TKS_USAGE, "the terrain has no finite bounds to place a camera by");
  const Bounds bounds = withExtent(given);
  if (view == "oblique") return std::vector{obliqueView(bounds)};
  if (view == "low") return std::vector{lowView(bounds)};
  if (view == "top") return std::vector{topView(bounds)};
  if (view == "all") return std::vector{obliqueView(bounds), lowView(bounds), topView(bounds)};
  return Status(TKS_USAGE, "no view is called '" + view + "': use oblique, low, top or all");
}

double parallaxOf(const std::vector<Camera>& cameras) {
  constexpr double kMost = 20;
  double sum = 0;
  for (const Camera& camera : cameras) {
    const Vec3 ray = subtract(camera.target, camera.eye);
    const double along = std::sqrt(ray[0] * ray[0] + ray[2] * ray[2]), down = std::abs(ray[1]);
    sum += along < kMost * down ? along / down : kMost;
  }
  return cameras.empty() ? 0 : sum / static_cast<double>(cameras.size());
}

}  // namespace tetrakis::tools
