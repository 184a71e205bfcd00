// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/rate_envelope.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::bench {
namespace {

/// At an error between those of two points.
double between(const ErrorPoint& a, const ErrorPoint& b, double error) {
  if (a.error == b.error) return std::min(a.cost, b.cost);
  const double share = std::log(error / a.error) / std::log(b.error / a.error);
  return a.cost * std::pow(b.cost / a.cost, share);
}

}  // namespace

std::optional<double> costAt(const std::vector<ErrorCurve>& curves, double error) {
  std::optional<double> passing;
  double serving = HUGE_VAL;
  for (const ErrorCurve& curve : curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      if (curve[i].error <= error) serving = std::min(serving, curve[i].cost);
      if (i == 0) continue;
      const auto [least, most] = std::minmax(curve[i - 1].error, curve[i].error);
      if (!(least <= error && error <= most)) continue;
      const double bytes = between(curve[i - 1], curve[i], error);
      passing = std::min(passing.value_or(bytes), bytes);
    }
  }
  if (passing) passing = std::min(*passing, serving);
  return passing;
}

std::optional<double> leastAt(const std::vector<ErrorCurve>& curves, double error) {
  std::optional<double> least = costAt(curves, error);
  for (const ErrorCurve& curve : curves)
    for (const ErrorPoint& point : curve)
      if (point.error <= error) least = std::min(least.value_or(point.cost), point.cost);
  return least;
}

}  // namespace tetrakis::bench
