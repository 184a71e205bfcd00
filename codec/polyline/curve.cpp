// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/curve.hpp"

#include <algorithm>
#include <numeric>

namespace tetrakis::inline polyline {
namespace {

std::vector<double> wholePlaces(size_t count) {
  std::vector<double> places(count);
  std::iota(places.begin(), places.end(), 0.0);
  return places;
}

double meanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Curve::Curve(std::span<const double> heights) : Curve(wholePlaces(heights.size()), heights) {}

Curve::Curve(std::span<const double> places, std::span<const double> heights)
    : knots_(heights.size()), before_(heights.size() + 1) {
  const double middle = meanOf(places), mean = meanOf(heights);
  for (size_t k = 0; k < heights.size(); ++k) {
    const double x = places[k] - middle, y = heights[k] - mean;
    const Sums& sums = before_[k];
    knots_[k] = {x, y};
    before_[k + 1] = {sums.x + x, sums.xx + x * x, sums.y + y, sums.yy + y * y, sums.xy + x * y};
  }
}

/// The chord is y = c + s x, so E is the sum of (y_k - c - s x_k)^2 over a < k < b:
/// Syy + (b - a - 1) c^2 + s^2 Sxx - 2 c Sy - 2 s Sxy + 2 c s Sx.
double Curve::error(uint32_t a, uint32_t b) const {
  if (b - a < 2) return 0;
  const Knot from = knots_[a], to = knots_[b];
  const Sums &first = before_[a + 1], &last = before_[b];
  const double s = (to.y - from.y) / (to.x - from.x), c = from.y - s * from.x;
  const double on_height = last.yy - first.yy - 2 * c * (last.y - first.y) + (b - a - 1) * c * c;
  const double on_slope =
      s * (s * (last.xx - first.xx) - 2 * (last.xy - first.xy) + 2 * c * (last.x - first.x));
  return std::max(on_height + on_slope, 0.0);
}

double Curve::deviation(uint32_t a, uint32_t k, uint32_t b) const {
  const Knot from = knots_[a], to = knots_[b], knot = knots_[k];
  const double chord = from.y + (to.y - from.y) * (knot.x - from.x) / (to.x - from.x);
  return (knot.y - chord) * (knot.y - chord);
}

double Curve::gain(uint32_t a, uint32_t k, uint32_t b) const {
  return error(a, b) - error(a, k) - error(k, b);
}

}  // namespace tetrakis::inline polyline
