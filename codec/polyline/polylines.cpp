// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/polylines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "codec/polyline/knots.hpp"

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

bool Polylines::has(uint32_t segments) const {
  return segments < errors.size() && !std::isnan(errors[segments]);
}

uint32_t Polylines::reached(uint32_t segments) const {
  uint32_t count = std::min(segments, static_cast<uint32_t>(errors.size()) - 1);
  while (!has(count)) --count;
  return count;
}

std::vector<uint32_t> Polylines::knots(uint32_t segments) const {
  std::vector<uint32_t> kept;
  if (entry.empty()) {
    auto k = static_cast<uint32_t>(before[1].size() - 1);
    kept.push_back(k);
    for (uint32_t c = segments; c > 0; --c) kept.push_back(k = before[c][k]);
    std::reverse(kept.begin(), kept.end());
    return kept;
  }
  for (uint32_t k = 0; k < entry.size(); ++k)
    if (entry[k] <= segments) kept.push_back(k);
  return kept;
}

/// Knots go in the falling order of their entries; what each of them adds to the error is a gain
/// between the neighbours that are left.
Polylines nestedPolylines(const Curve& curve, std::vector<uint32_t> entry,
                          const Operations& operations) {
  const uint32_t last = curve.size() - 1;
  std::vector<uint32_t> order(last - 1);
  std::iota(order.begin(), order.end(), 1U);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return entry[a] > entry[b]; });
  std::vector<double> errors(curve.size(), std::numeric_limits<double>::quiet_NaN());
  LinkedKnots left(curve.size());
  double error = 0;
  for (uint32_t gone = 0; gone < order.size(); ++gone) {
    const uint32_t k = order[gone];
    if (gone == 0 || entry[k] != entry[order[gone - 1]]) errors[last - gone] = error;
    error += curve.gain(left.before(k), k, left.after(k));
    left.remove(k);
  }
  errors[1] = error;
  Polylines polylines;
  polylines.errors = std::move(errors);
  polylines.entry = std::move(entry);
  polylines.operations = operations;
  return polylines;
}

double errorOf(const Curve& curve, std::span<const uint32_t> knots) {
  double error = 0;
  for (size_t i = 1; i < knots.size(); ++i) error += curve.error(knots[i - 1], knots[i]);
  return error;
}

const std::array<Algorithm, 8> kAlgorithms = {{
    {"uoptimal", uoptimal, 0, false, false},
    {"urefine", urefine, 3, true, false},
    {"udecimate", udecimate, 5, true, false},
    {"udecimate-global", udecimateGlobal, 5, true, false},
    {"crefine", crefine, 1, true, true},
    {"cdecimate", cdecimate, 1, true, true},
    {"cglobal", cglobal, 5, true, true},
    {"coptimal", coptimal, 7, true, true},
}};

}  // namespace tetrakis::inline polyline
