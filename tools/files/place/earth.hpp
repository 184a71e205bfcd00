// SPDX-License-Identifier: Apache-2.0
// Lengths on the WGS 84 ellipsoid, for rasters in degrees.
#pragma once

#include <cmath>
#include <numbers>

namespace tetrakis::tools {

/// 0 when unknown.
struct MetresPerDegree {
  double east = 0, north = 0;
};

/// At a geodetic latitude in degrees; unknown outside (-90, 90). Radii of curvature of the meridian
/// M = a (1 - e2) / w^3 and of the prime vertical N = a / w, with w = sqrt(1 - e2 sin^2 latitude).
inline MetresPerDegree metresPerDegree(double latitude) {
  if (!(std::abs(latitude) < 90)) return {};
  constexpr double kSemiMajorAxis = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kE2 = kFlattening * (2 - kFlattening);
  constexpr double kRadian = std::numbers::pi / 180;
  const double sine = std::sin(latitude * kRadian), w = std::sqrt(1 - kE2 * sine * sine);
  return {kRadian * kSemiMajorAxis / w * std::cos(latitude * kRadian),
          kRadian * kSemiMajorAxis * (1 - kE2) / (w * w * w)};
}

}  // namespace tetrakis::tools
