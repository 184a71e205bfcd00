// SPDX-License-Identifier: Apache-2.0
// LongitudeTrail follows longitudes from neighbour to neighbour and tells whether the antimeridian
// lies between two of them.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

namespace tetrakis::tools {

/// Follows longitudes from neighbour to neighbour, and tells where these are counted from both ends
/// of the map. One on the antimeridian itself may have either sign, and says nothing.
class LongitudeTrail {
 public:
  bool comesApart(double longitude) {
    constexpr double kSlack = 1e-6;
    if (std::abs(std::abs(longitude) - 180) < kSlack) return false;
    const double before = std::exchange(last_, longitude);
    return std::abs(longitude - before) > 180;
  }

 private:
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace tetrakis::tools
