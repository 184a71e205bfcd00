// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/picture_point.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/portable_math.hpp"
#include "codec/ground/sky.hpp"

namespace tetrakis::inline pictures {

CameraPoints::CameraPoints(const Camera& camera) : height_(camera.height) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = portable::tan(camera.fov_y * std::numbers::pi / 360);
  const double pixel = 2 * tan_y / camera.height;
  origin_.right = scale(axes.right, pixel);
  origin_.down = scale(axes.up, -pixel);
  origin_.ray.origin = camera.eye;
  corner_ = add(axes.forward, add(scale(origin_.right, camera.width / -2.0),
                                  scale(origin_.down, camera.height / -2.0)));
}

PicturePoint CameraPoints::at(double column, double row) const {
  PicturePoint point = origin_;
  point.ray.direction = add(corner_, add(scale(point.right, column), scale(point.down, row)));
  const double last = height_ - 1.0;
  const auto sky = skyAt(static_cast<uint32_t>(std::clamp(row, 0.0, last)), height_);
  for (size_t c = 0; c < 3; ++c) point.sky[c] = static_cast<float>(sky[c]);
  return point;
}

SeenPoint seenAt(const PicturePoint& point, const GroundRays& ground, Extent texture) {
  SeenPoint seen;
  const auto hit = ground.hit(point.ray);
  if (!hit) return seen;
  const double columns = ground.frame().width - 1.0, rows = ground.frame().height - 1.0;
  seen.ground = true;
  seen.u = hit->column / columns;
  seen.v = hit->row / rows;
  // Distances are measured along the plane of the triangle. A triangle that is seen edge on is as
  // wide as the texture at most.
  const auto texelsTo = [&](const Vec3& change) {
    const Ray ray{point.ray.origin, add(point.ray.direction, scale(change, 0.5))};
    const auto place = ground.onPlane(*hit, ray);
    const double u = place ? std::clamp((*place)[0] / columns - seen.u, -1.0, 1.0) : 1;
    const double v = place ? std::clamp((*place)[1] / rows - seen.v, -1.0, 1.0) : 1;
    const double texels_u = u * texture.width, texels_v = v * texture.height;
    return std::sqrt(texels_u * texels_u + texels_v * texels_v);
  };
  const double wide = std::max(texelsTo(point.right), texelsTo(point.down));
  seen.level = wide > 0 ? std::max(0.0, portable::log2(wide)) : 0;
  return seen;
}

Colour colourOf(const PicturePoint& point, const SeenPoint& seen, const ScreenTexture& texture) {
  return seen.ground ? texture.at(seen.u, seen.v, seen.level) : point.sky;
}

double squaresBetween(const Colour& a, const Colour& b) {
  double squares = 0;
  for (size_t c = 0; c < 3; ++c) squares += double{a[c] - b[c]} * double{a[c] - b[c]};
  return squares;
}

std::vector<double> sharesOf(const std::vector<Camera>& cameras) {
  double most = 0, weights = 0;
  for (const Camera& camera : cameras) most = std::max(most, camera.weight);
  assert(most > 0);
  for (const Camera& camera : cameras) weights += camera.weight / most;
  std::vector<double> shares;
  for (const Camera& camera : cameras) shares.push_back(camera.weight / most / weights);
  return shares;
}

}  // namespace tetrakis::inline pictures
