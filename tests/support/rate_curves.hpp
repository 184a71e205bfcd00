// SPDX-License-Identifier: Apache-2.0
// Accounts of tracks that no track has, for the tests of rate control.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// Falls, but not in every point, and ends at 0.
inline std::vector<RatePoint> bumpyCurve(uint64_t step, double scale) {
  std::vector<RatePoint> points;
  for (uint64_t i = 0; i < 60; ++i) {
    const double bump = i % 3 == 1 ? 1.15 : 1.0;
    points.push_back({i * step, scale * std::exp(-0.1 * static_cast<double>(i)) * bump});
  }
  points.back().distortion = 0;
  return points;
}

/// Distortion removed per byte.
inline double slope(const RatePoint& a, const RatePoint& b) {
  return (a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes);
}

}  // namespace tetrakis
