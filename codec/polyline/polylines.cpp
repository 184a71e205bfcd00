// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/polylines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "codec/polyline/linked_knots.hpp"

namespace tetrakis::inline polyline {

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

}  // namespace tetrakis::inline polyline
