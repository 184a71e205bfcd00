// SPDX-License-Identifier: Apache-2.0
#include "codec/ground/camera.hpp"

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

HalfAngles halfAngles(const Camera& camera) {
  constexpr double kRadian = std::numbers::pi / 180;
  const double tan_y = portable::tan(camera.fov_y * kRadian / 2);
  return {tan_y * camera.width / camera.height, tan_y};
}

/// Returns the camera, with its direction and its angle, at the nearest place from which it sees
/// the whole box with a small margin, in the middle of the picture.
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

constexpr double kRadian = std::numbers::pi / 180;
/// Degrees. The angle is narrow, so that far ground is not much smaller than near ground.
constexpr double kOverviewAngle = 25;
/// Pixels a side of the pictures around an object.
constexpr uint32_t kPictureAround = 512;

Camera obliqueView(const Bounds& bounds) {
  constexpr double kElevation = 35 * kRadian;
  Camera camera;
  camera.name = "oblique";
  camera.fov_y = kOverviewAngle;
  camera.target = centreOf(bounds);
  camera.eye = add(camera.target, Vec3{0, portable::sin(kElevation), portable::cos(kElevation)});
  return seeingAll(camera, bounds);
}

Camera topView(const Bounds& bounds) {
  Camera camera;
  camera.name = "top";
  camera.fov_y = kOverviewAngle;
  camera.up = {0, 0, -1};
  camera.target = centreOf(bounds);
  camera.eye = add(camera.target, Vec3{0, 1, 0});
  return seeingAll(camera, bounds);
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
  const double border_angle = portable::atan(above_middle / distance);
  const double tan_half = halfAngles(camera).tan_y;
  const double pitch = std::min(border_angle + portable::atan(0.6 * tan_half), 80 * kRadian);
  const double reach = above_middle / portable::tan(pitch);
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

/// (x, y, z) turned by so many quarters about the vertical.
Vec3 turned(const Vec3& v, int quarters) {
  switch (quarters) {
    case 1:
      return {v[2], v[1], -v[0]};
    case 2:
      return {-v[0], v[1], -v[2]};
    case 3:
      return {-v[2], v[1], v[0]};
    default:
      return v;
  }
}

/// The view from four sides, each of a quarter of the weight.
std::vector<Camera> fromFourSides(Camera (*view)(const Bounds&), const Bounds& bounds) {
  constexpr const char* kSides[] = {"", "-east", "-north", "-west"};
  std::vector<Camera> cameras;
  for (int side = 0; side < 4; ++side) {
    // The terrain is turned before the camera, and the camera back.
    const Vec3 a = turned(bounds.low, (4 - side) % 4), b = turned(bounds.high, (4 - side) % 4);
    Bounds box;
    for (size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(a[axis], b[axis]);
      box.high[axis] = std::max(a[axis], b[axis]);
    }
    Camera camera = view(box);
    camera.name += kSides[side];
    camera.eye = turned(camera.eye, side);
    camera.target = turned(camera.target, side);
    camera.up = turned(camera.up, side);
    camera.weight = 0.25;
    cameras.push_back(camera);
  }
  return cameras;
}

Status checkBounds(const Bounds& bounds) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(bounds.low[axis]) || !std::isfinite(bounds.high[axis]))
      return Status(TKS_USAGE, "the terrain has no finite bounds to place a camera by");
  return Status();
}

}  // namespace

Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& given) {
  if (Status status = checkBounds(given); !status.ok()) return status;
  const Bounds bounds = withExtent(given);
  if (view == "oblique") return std::vector{obliqueView(bounds)};
  if (view == "low") return std::vector{lowView(bounds)};
  if (view == "top") return std::vector{topView(bounds)};
  if (view == "all") return std::vector{obliqueView(bounds), lowView(bounds), topView(bounds)};
  if (view == "orbit") return fromFourSides(obliqueView, bounds);
  if (view == "any") return unknownViewer(given);
  if (view == "around") return camerasAround(given);
  return Status(TKS_USAGE, "no view is called '" + view +
                               "': use oblique, low, top, orbit, all, any or around");
}

Result<std::vector<Camera>> unknownViewer(const Bounds& given) {
  if (Status status = checkBounds(given); !status.ok()) return status;
  const Bounds bounds = withExtent(given);
  std::vector<Camera> cameras = fromFourSides(obliqueView, bounds);
  const std::vector<Camera> low = fromFourSides(lowView, bounds);
  cameras.insert(cameras.end(), low.begin(), low.end());
  cameras.push_back(topView(bounds));
  return cameras;
}

Result<std::vector<Camera>> camerasAround(const Bounds& given) {
  if (Status status = checkBounds(given); !status.ok()) return status;
  const Bounds bounds = withExtent(given);
  const double away = length(subtract(bounds.high, bounds.low));
  std::vector<Camera> cameras;
  for (int place = 0; place < 27; ++place) {
    const std::array<int, 3> steps = {place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1};
    const auto still = std::count(steps.begin(), steps.end(), 0);
    if (still == 1 || still == 3) continue;  // an edge, or the middle
    Camera camera;
    camera.name = "around-" + std::to_string(cameras.size() + 1);
    camera.fov_y = kOverviewAngle;
    camera.width = camera.height = kPictureAround;
    if (steps[0] == 0 && steps[2] == 0) camera.up = {0, 0, -1};
    camera.target = centreOf(bounds);
    for (size_t axis = 0; axis < 3; ++axis)
      camera.eye[axis] = camera.target[axis] + away * steps[axis];
    cameras.push_back(seeingAll(camera, bounds));
  }
  return cameras;
}

}  // namespace tetrakis::inline ground
