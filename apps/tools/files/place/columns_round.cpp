// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/columns_round.hpp"

#include <cmath>

#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {

ColumnsRound columnsRound(const Georeference& place, uint32_t width) {
  /// Of a column: files write the width of one with some seven digits or more. A larger number
  /// glues sides with a gap in between.
  constexpr double kTolerance = 0.01;
  if (!place.geotransform) return ColumnsRound::kNo;
  const GeoTransform& transform = *place.geotransform;
  const double degrees = transform[1] * gridUnitOf(place.geo_keys, place.crs).degrees;
  if (degrees == 0 || transform[2] != 0 || transform[4] != 0) return ColumnsRound::kNo;
  const double more = width - std::abs(360 / degrees);
  if (std::abs(more) < kTolerance) return ColumnsRound::kOnce;
  return std::abs(more - 1) < kTolerance ? ColumnsRound::kRepeating : ColumnsRound::kNo;
}

}  // namespace tetrakis::tools
