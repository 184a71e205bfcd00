// SPDX-License-Identifier: Apache-2.0
// Perspective with a depth range that fits the scene, so that 24 bits of depth suffice.
#include "apps/tools/render/projection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "codec/ground/camera.hpp"

namespace tetrakis::tools {
namespace {

struct DepthRange {
  double near, far;
};

/// A point at distance r within the picture lies at least r cos(half diagonal angle) deep.
DepthRange depthRange(const Camera& camera, const Vec3& forward, const Bounds& box,
                      double cos_diagonal) {
  double nearest = HUGE_VAL, farthest = -HUGE_VAL, distance = 0;
  for (size_t i = 0; i < 8; ++i) {
    Vec3 corner;
    for (size_t axis = 0; axis < 3; ++axis)
      corner[axis] = (i >> axis & 1u) ? box.high[axis] : box.low[axis];
    const double depth = dot(subtract(corner, camera.eye), forward);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    const double outside =
        std::max({box.low[axis] - camera.eye[axis], camera.eye[axis] - box.high[axis], 0.0});
    distance += outside * outside;
  }
  if (!(farthest > 0)) return {1, 2};  // all of it lies behind the camera
  constexpr double kLeast = 2e-4;      // of the farthest, for eyes inside the box
  const double closest = std::max(nearest, std::sqrt(distance) * cos_diagonal);
  return {std::max(0.99 * closest, kLeast * farthest), 1.01 * farthest};
}

}  // namespace

std::array<float, 16> projectionOf(const Camera& camera, const Bounds& box) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = std::tan(camera.fov_y * std::numbers::pi / 360);
  const double tan_x = tan_y * camera.width / camera.height;
  const double cos_diagonal = 1 / std::sqrt(1 + tan_x * tan_x + tan_y * tan_y);
  const DepthRange range = depthRange(camera, axes.forward, box, cos_diagonal);
  // Clip coordinates of a point p with q = p - eye: x = q.right / tan_x, y = q.up / tan_y,
  // w = q.forward, z = (w (far + near) - 2 far near) / (far - near).
  const double slope = (range.far + range.near) / (range.far - range.near);
  const double offset = -2 * range.far * range.near / (range.far - range.near);
  const Vec3 rows[4] = {scale(axes.right, 1 / tan_x), scale(axes.up, 1 / tan_y),
                        scale(axes.forward, slope), axes.forward};
  std::array<float, 16> matrix;
  for (size_t row = 0; row < 4; ++row) {
    for (size_t column = 0; column < 3; ++column)
      matrix[4 * column + row] = static_cast<float>(rows[row][column]);
    const double shift = -dot(rows[row], camera.eye) + (row == 2 ? offset : 0);
    matrix[12 + row] = static_cast<float>(shift);
  }
  return matrix;
}

}  // namespace tetrakis::tools
