// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/ring_flattening.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/portable_math.hpp"
#include "codec/remesh/quick_angles.hpp"

namespace tetrakis::inline remesh {
namespace {

using std::numbers::pi;

constexpr double kSmallestAngle = 0.02;    // of a triangle, before angles are scaled
constexpr double kWidestAngle = 0.9 * pi;  // of a triangle, after angles are scaled
constexpr double kSmallestRadius = 1e-3;   // relative to the largest one
/// The least thickness of a triangle, or half the least one of the ring itself if that is less.
constexpr double kThinnest = 0.02;

/// The angle between two directions, from 0 to pi.
double spokeAngle(const Point& a, const Point& b) {
  return quickAngle(dot(a, b), length(cross(a, b)));
}

/// Scales angles from their sum `sum` to the sum `total`. If one of them is too wide then, all are
/// moved towards their mean until it is not.
void scaleAngles(std::vector<double>& angles, double sum, double total) {
  double widest = 0;
  for (double& angle : angles) {
    angle *= total / sum;
    widest = std::max(widest, angle);
  }
  if (widest <= kWidestAngle) return;
  const double even = total / static_cast<double>(angles.size());
  const double share = (widest - kWidestAngle) / (widest - even);
  for (double& angle : angles) angle += share * (even - angle);
}

/// The thickness of the triangle between the origin and two points: twice its area, divided by the
/// square of its longest side. It is negative if the triangle is turned over.
double thickness(const FlatPoint& a, const FlatPoint& b) {
  const auto squared = [](const FlatPoint& p) { return p.x * p.x + p.y * p.y; };
  return cross(a, b) / std::max({squared(a), squared(b), squared(b - a)});
}

}  // namespace

void flatten(const std::vector<Point>& points, const Ring& ring, std::vector<FlatPoint>& flat) {
  const size_t count = ring.points.size();
  std::vector<Point> spokes(count);
  std::vector<double> radii(count), angles(ring.triangles());
  for (size_t i = 0; i < count; ++i) {
    spokes[i] = points[ring.points[i]] - points[ring.centre];
    radii[i] = length(spokes[i]);
  }
  double sum = 0;
  for (uint32_t i = 0; i < angles.size(); ++i)
    sum += angles[i] = std::max(kSmallestAngle, spokeAngle(spokes[i], spokes[ring.next(i)]));
  const double total = ring.closed ? 2 * pi : pi;
  scaleAngles(angles, sum, total);
  const double power = std::clamp(total / sum, 1.0 / 3, 3.0);
  const double largest = *std::max_element(radii.begin(), radii.end());
  flat.resize(count);
  double angle = ring.closed ? -pi : 0;
  for (size_t i = 0; i < count; ++i) {
    const double ratio = largest > 0 ? radii[i] / largest : 1;
    const double radius = std::max(kSmallestRadius, ratio > 0 ? portable::pow(ratio, power) : 0);
    if (i == 0) {
      flat[i] = {ring.closed ? -radius : radius, 0};
    } else if (i == angles.size()) {
      flat[i] = {-radius, 0};  // on a line with the first point of an open ring
    } else {
      const FlatPoint direction = quickDirection(angle);
      flat[i] = {radius * direction.x, radius * direction.y};
    }
    if (i < angles.size()) angle += angles[i];
  }
}

bool fansOut(const Ring& ring, const std::vector<FlatPoint>& flat, uint32_t target) {
  double thinnest = kThinnest;
  for (uint32_t i = 0; i < ring.triangles(); ++i)
    thinnest = std::min(thinnest, thickness(flat[i], flat[ring.next(i)]) / 2);
  for (uint32_t i = 0; i < ring.triangles(); ++i) {
    if (vanishes(ring, i, target)) continue;
    if (!(thickness(flat[i] - flat[target], flat[ring.next(i)] - flat[target]) > thinnest))
      return false;
  }
  return true;
}

}  // namespace tetrakis::inline remesh
