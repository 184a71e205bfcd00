// SPDX-License-Identifier: Apache-2.0
// metresPerDegree() gives the length of a degree on an ellipsoid, for rasters in degrees.
#pragma once

#include <cmath>
#include <numbers>

namespace tetrakis::tools {

/// The Earth's, as WGS 84 has it, unless somebody says otherwise.
struct Ellipsoid {
  double semi_major = 6378137.0, flattening = 1 / 298.257223563;
};

/// 0 when unknown.
struct MetresPerDegree {
  double east = 0, north = 0;
};

/// At a geodetic latitude in degrees; unknown outside (-90, 90). Radii of curvature of the meridian
/// M = a (1 - e2) / w^3 and of the prime vertical N = a / w, with w = sqrt(1 - e2 sin^2 latitude).
inline MetresPerDegree metresPerDegree(double latitude, const Ellipsoid& ellipsoid = {}) {
  if (!(std::abs(latitude) < 90)) return {};
  const double axis = ellipsoid.semi_major;
  const double e2 = ellipsoid.flattening * (2 - ellipsoid.flattening);
  constexpr double kRadian = std::numbers::pi / 180;
  const double sine = std::sin(latitude * kRadian), w = std::sqrt(1 - e2 * sine * sine);
  return {kRadian * axis / w * std::cos(latitude * kRadian),
          kRadian * axis * (1 - e2) / (w * w * w)};
}

}  // namespace tetrakis::tools
