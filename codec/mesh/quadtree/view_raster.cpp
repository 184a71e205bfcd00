// SPDX-License-Identifier: Apache-2.0
// viewFootprint() takes a camera to the polygon of ground that it sees, and ViewRaster the polygon
// to spans of nodes in each level.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "codec/mesh/quadtree/mesh_tree.hpp"

namespace tetrakis::inline quadtree {

// From a view frustum to the ground below it: Fourier-Motzkin elimination of the height, then a
// polygon clipped by half-planes (Sutherland and Hodgman 1974).

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

// A convex polygon into spans, level by level; see mesh_tree.hpp.

namespace {

constexpr double kSlack = 1e-6;  ///< samples: more than the corners of a footprint are rounded by

/// The square of side 1 that holds a coordinate, of `count` squares.
uint32_t squareAt(double coordinate, uint32_t count) {
  return static_cast<uint32_t>(std::clamp(std::floor(coordinate), 0.0, count - 1.0));
}

}  // namespace

ViewRaster::ViewRaster(QuadtreeShape shape, std::span<const MapPoint> polygon)
    : levels_(shape.depth + 1) {
  if (polygon.empty()) return;
  const auto [north, south] = std::minmax_element(polygon.begin(), polygon.end(),
                                                  [](MapPoint a, MapPoint b) { return a.y < b.y; });
  Rows& finest = levels_[shape.depth];
  finest.first = squareAt(north->y - kSlack, shape.rowsOf(shape.depth));
  finest.spans.resize(squareAt(south->y + kSlack, shape.rowsOf(shape.depth)) - finest.first + 1);
  for (size_t i = 0; i < polygon.size(); ++i)
    addEdge(polygon[i], polygon[(i + 1) % polygon.size()], finest, shape);
  for (uint32_t level = shape.depth; level-- > 0;) {
    const Rows& below = levels_[level + 1];
    Rows& rows = levels_[level];
    rows.first = below.first / 2;
    rows.spans.resize((below.first + below.spans.size() - 1) / 2 - rows.first + 1);
    for (uint32_t i = 0; i < below.spans.size(); ++i)
      rows.widen((below.first + i) / 2, {below.spans[i].first / 2, below.spans[i].last / 2});
  }
}

void ViewRaster::Rows::widen(uint32_t row, Span by) {
  Span& span = spans[row - first];
  const bool empty = span.first > span.last;
  span = empty ? by : Span{std::min(span.first, by.first), std::max(span.last, by.last)};
}

/// Each row between the ends gets the part of the edge that lies in it.
void ViewRaster::addEdge(MapPoint p, MapPoint q, Rows& rows, const QuadtreeShape& shape) const {
  if (p.y > q.y) std::swap(p, q);
  const uint32_t columns = shape.columnsOf(shape.depth), last_row = shape.rowsOf(shape.depth);
  const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0;
  const auto xAt = [&](double y) {
    return y <= p.y ? p.x : y >= q.y ? q.x : p.x + (y - p.y) * slope;
  };
  const uint32_t end = squareAt(q.y + kSlack, last_row);
  for (uint32_t row = squareAt(p.y - kSlack, last_row); row <= end; ++row) {
    double low = xAt(row - kSlack), high = xAt(row + 1 + kSlack);
    if (q.y == p.y) low = p.x, high = q.x;
    if (low > high) std::swap(low, high);
    rows.widen(row, {squareAt(low - kSlack, columns), squareAt(high + kSlack, columns)});
  }
}

}  // namespace tetrakis::inline quadtree
