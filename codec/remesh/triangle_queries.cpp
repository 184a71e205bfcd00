// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/triangle_queries.hpp"

#include <algorithm>

namespace tetrakis::inline remesh {
namespace {

/// If the squared sine of a corner is not above this, the triangle counts as its three sides alone.
constexpr double kThinSquare = 1e-12;

/// The foot of the perpendicular from a point to a triangle, by the weights of the corners; nothing
/// if it lies outside. Corner 0 is the origin, `side1` and `side2` lead from it to the others.
std::optional<std::array<double, 3>> footInside(const Point& side1, const Point& side2,
                                                const Point& to_point) {
  const Point normal = cross(side1, side2);
  const double square = dot(normal, normal);
  if (!(square > kThinSquare * dot(side1, side1) * dot(side2, side2))) return {};
  const double weight1 = dot(cross(to_point, side2), normal) / square;
  const double weight2 = dot(cross(side1, to_point), normal) / square;
  const double weight0 = 1 - weight1 - weight2;
  if (!(weight0 >= 0 && weight1 >= 0 && weight2 >= 0)) return {};
  return std::array{weight0, weight1, weight2};
}

/// The weight of `end` at the place between `start` and `end` that is nearest to `point`.
double nearestBetween(const Point& start, const Point& end, const Point& point) {
  const Point side = end - start;
  const double square = dot(side, side);
  return square > 0 ? std::clamp(dot(point - start, side) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

NearPlace nearestInTriangle(const TriangleMesh& mesh, uint32_t triangle, const Point& point) {
  const Triangle& t = mesh.triangles[triangle];
  const std::array corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
  NearPlace best{{triangle, {1, 0, 0}}, length(corners[0] - point)};
  const Point& start = corners[0];
  if (const auto foot = footInside(corners[1] - start, corners[2] - start, point - start)) {
    best.place.weights = *foot;
    best.distance = length(at(mesh, best.place) - point);
    return best;
  }
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    const double weight = nearestBetween(corners[k], corners[next], point);
    SurfacePoint place{triangle, {0, 0, 0}};
    place.weights[k] = 1 - weight;
    place.weights[next] = weight;
    const double distance = length(at(mesh, place) - point);
    if (distance < best.distance) best = {place, distance};
  }
  return best;
}

LineSight::LineSight(const Line& line) : line_(line) {
  const Point& d = line.direction;
  size_t steepest = 0;
  for (size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(d[axis]) > std::abs(d[steepest])) steepest = axis;
  }
  axes_ = {(steepest + 1) % 3, (steepest + 2) % 3, steepest};
  across_ = d[axes_[0]] / d[steepest];
  up_ = d[axes_[1]] / d[steepest];
}

Point LineSight::sheared(const Point& point) const {
  const Point p = point - line_.origin;
  const double depth = p[axes_[2]];
  return {p[axes_[0]] - across_ * depth, p[axes_[1]] - up_ * depth,
          depth / line_.direction[axes_[2]]};
}

std::optional<Crossing> LineSight::crossing(const TriangleMesh& mesh, uint32_t triangle) const {
  const Triangle& corners = mesh.triangles[triangle];
  const Point a = sheared(mesh.points[corners[0]]);
  const Point b = sheared(mesh.points[corners[1]]);
  const Point c = sheared(mesh.points[corners[2]]);
  const std::array areas{b[0] * c[1] - b[1] * c[0], c[0] * a[1] - c[1] * a[0],
                         a[0] * b[1] - a[1] * b[0]};
  const auto [least, largest] = std::minmax({areas[0], areas[1], areas[2]});
  if (least < 0 && largest > 0) return {};
  const double area = areas[0] + areas[1] + areas[2];
  if (area == 0) return {};
  const SurfacePoint place{triangle, {areas[0] / area, areas[1] / area, areas[2] / area}};
  const double t = place.weights[0] * a[2] + place.weights[1] * b[2] + place.weights[2] * c[2];
  if (!(t >= line_.first && t <= line_.last)) return {};
  return Crossing{t, place, (area > 0) == (line_.direction[axes_[2]] > 0)};
}

}  // namespace tetrakis::inline remesh
