// SPDX-License-Identifier: Apache-2.0
// From a view frustum to the ground below it: Fourier-Motzkin elimination of the height, then a
// polygon clipped by half-planes (Sutherland and Hodgman 1974).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "codec/mesh/quadtree/view_raster.hpp"

namespace tetrakis::inline quadtree {
namespace {

/// a x + b y + c h + d >= 0.
struct HalfSpace {
  double a = 0, b = 0, c = 0, d = 0;
};

/// Scaled so that the largest coefficient is 1: nothing below overflows.
HalfSpace normalized(const HalfSpace& p) {
  const double largest = std::max({std::abs(p.a), std::abs(p.b), std::abs(p.c), std::abs(p.d)});
  if (largest == 0) return p;
  return {p.a / largest, p.b / largest, p.c / largest, p.d / largest};
}

HalfSpace combine(double s, const HalfSpace& p, double t, const HalfSpace& q) {
  return normalized({s * p.a + t * q.a, s * p.b + t * q.b, s * p.c + t * q.c, s * p.d + t * q.d});
}

/// The four sides of the frustum, which together imply w >= 0, and the range of the heights.
std::vector<HalfSpace> boundsOf(const std::array<double, 16>& clip, const MapBox& box) {
  double largest = 0;
  for (const double value : clip) largest = std::max(largest, std::abs(value));
  const double scale = largest > 0 ? 1 / largest : 1;
  const auto row = [&](size_t i) {
    return HalfSpace{clip[4 * i] * scale, clip[4 * i + 1] * scale, clip[4 * i + 2] * scale,
                     clip[4 * i + 3] * scale};
  };
  return {combine(1, row(3), 1, row(0)),   combine(1, row(3), -1, row(0)),
          combine(1, row(3), 1, row(1)),   combine(1, row(3), -1, row(1)),
          normalized({0, 0, 1, -box.low}), normalized({0, 0, -1, box.high})};
}

/// Keeps the part of a convex polygon where a x + b y + d >= 0.
std::vector<MapPoint> clipped(const std::vector<MapPoint>& polygon, const HalfSpace& plane) {
  const auto side = [&](MapPoint p) { return plane.a * p.x + plane.b * p.y + plane.d; };
  std::vector<MapPoint> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const MapPoint p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double at_p = side(p), at_q = side(q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p >= 0) == (at_q >= 0)) continue;
    const double t = at_p / (at_p - at_q);
    kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
  }
  return kept;
}

}  // namespace

MapBox MapBox::around(uint32_t width, uint32_t height, std::span<const float> heights) {
  assert(width > 0 && height > 0);
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (const float value : heights) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {width - 1.0, height - 1.0, low, high};
}

std::vector<MapPoint> viewFootprint(const std::array<double, 16>& clip, const MapBox& box) {
  std::vector<MapPoint> polygon{{0, 0}, {0, box.bottom}, {box.right, box.bottom}, {box.right, 0}};
  // Some height fits where every lower bound of it (c > 0) lies below every upper bound (c < 0).
  const std::vector<HalfSpace> bounds = boundsOf(clip, box);
  for (const HalfSpace& lower : bounds) {
    if (lower.c == 0) polygon = clipped(polygon, lower);
    if (!(lower.c > 0)) continue;
    for (const HalfSpace& upper : bounds)
      if (upper.c < 0) polygon = clipped(polygon, combine(-upper.c, lower, lower.c, upper));
  }
  return polygon;
}

}  // namespace tetrakis::inline quadtree
