// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/edge_latitudes.hpp"

#include <cmath>

#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {

std::array<double, 2> edgeLatitudes(const Georeference& place, uint32_t height) {
  if (!place.geotransform) return {};
  const GeoTransform& transform = *place.geotransform;
  const double degrees = gridUnitOf(place.geo_keys, place.crs).degrees;
  const double first = degrees * transform[3], last = first + degrees * height * transform[5];
  /// Edges of samples at a pole lie behind it. What is farther off is no latitude.
  constexpr double kFarthest = 180;
  const bool placed = std::abs(first) <= kFarthest && std::abs(last) <= kFarthest;
  if (degrees == 0 || transform[4] != 0 || !placed) return {};
  return {first, last};
}

}  // namespace tetrakis::tools
