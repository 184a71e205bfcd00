// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/globe_sight.hpp"

#include <cstddef>
#include <optional>

namespace tetrakis::inline receiver {

namespace {

bool facesAway(const GlobePoint& point, const Vec3& eye) {
  return !(dot(point.up, subtract(eye, point.at)) > 0);
}

/// Square metres of a sample.
double areaOf(const GlobePoint& point) {
  return length(cross(point.column, point.row));
}

/// Globes are lit: a height error that moves nothing, as below the viewer, is seen as a shade. It
/// counts as what leans a point by half of its height.
GroundPoint shown(const GlobePoint& point, const Eye& eye) {
  constexpr double kShade = 0.25;
  const std::optional<PixelsBy> by = pixelsBy(eye, point.at);
  if (!by) return {};
  GroundPoint seen = shownPoint(by->along(point.column), by->along(point.row), by->along(point.up));
  if (seen.pixels > 0)
    seen.parallax += kShade * dot(point.up, point.up) * seen.pixels / areaOf(point);
  return seen;
}

}  // namespace

SeenRaster sightOf(const GlobeGround& ground, const Eye& eye) {
  const std::optional<Vec3> from = placeOf(eye);
  SeenRaster seen{ground.columns, ground.rows, {}};
  seen.points.reserve(ground.points.size());
  for (const GlobePoint& point : ground.points) {
    const bool is_hidden = from && facesAway(point, *from);
    seen.points.push_back(is_hidden ? GroundPoint{} : shown(point, eye));
  }
  return seen;
}

SeenRaster sightAround(const GlobeGround& ground, const SeenRaster& seen) {
  double area = 0, pixels = 0, parallax = 0;
  for (size_t i = 0; i < ground.points.size(); ++i) {
    const GroundPoint& point = seen.points[i];
    if (!(point.pixels > 0)) continue;
    area += areaOf(ground.points[i]);
    pixels += point.pixels;
    parallax += point.pixels * point.parallax;
  }
  SeenRaster around{ground.columns, ground.rows, std::vector<GroundPoint>(ground.points.size())};
  if (!(area > 0)) return around;
  for (size_t i = 0; i < ground.points.size(); ++i)
    around.points[i] = {pixels / area * areaOf(ground.points[i]), parallax / pixels};
  return around;
}

}  // namespace tetrakis::inline receiver
