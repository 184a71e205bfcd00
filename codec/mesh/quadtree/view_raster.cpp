// SPDX-License-Identifier: Apache-2.0
// A convex polygon into spans, level by level; see view_raster.hpp.
#include "codec/mesh/quadtree/view_raster.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline quadtree {
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
