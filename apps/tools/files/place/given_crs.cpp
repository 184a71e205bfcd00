// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/given_crs.hpp"

#include "apps/tools/files/place/crs_units.hpp"
#include "apps/tools/files/place/geo_keys.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/place/proj_objects.hpp"

namespace tetrakis::tools {

void giveCrs(HeightFile& heights, const std::string& crs) {
  heights.crs = withUpperCaseAuthority(crs);
  heights.geo_keys.clear();
  if (crsUnit(crs, CrsAxis::kVertical)) heights.vertical_datum.clear();
  setGroundSpacing(heights);
}

void giveVerticalDatum(HeightFile& heights, const std::string& datum) {
  heights.vertical_datum = datum;
  std::optional<GeoKeys> keys = parseGeoKeys(heights.geo_keys);
  if (!keys) return;
  for (const GeoKey key :
       {kVerticalGeoKey, kVerticalCitationGeoKey, kVerticalDatumGeoKey, kVerticalUnitsGeoKey})
    keys->remove(key);
  keys->minor_revision = 1;
  heights.geo_keys = textOf(*keys);
}

}  // namespace tetrakis::tools
