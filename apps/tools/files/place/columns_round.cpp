// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/columns_round.hpp"

#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {

ColumnsRound columnsRound(const Georeference& place, uint32_t width) {
  if (!place.geotransform) return ColumnsRound::kNo;
  const double degrees = gridUnitOf(place.geo_keys, place.crs).degrees;
  return tetrakis::columnsRound(place.geotransform->data(), degrees, width);
}

}  // namespace tetrakis::tools
