// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/ground_spacing.hpp"

#include <cmath>

#include "apps/tools/files/place/crs_units.hpp"
#include "apps/tools/files/place/earth.hpp"
#include "apps/tools/files/place/geo_units.hpp"
#include "apps/tools/files/place/map_scale.hpp"

namespace tetrakis::tools {

std::optional<std::array<double, 2>> groundSpacing(const GeoTransform& t, uint32_t width,
                                                   uint32_t height, const GridUnit& unit,
                                                   const std::string& crs) {
  const double middle = t[3] + width / 2.0 * t[4] + height / 2.0 * t[5];
  MetresPerDegree metres{unit.metres, unit.metres};
  if (unit.degrees > 0) {
    metres = metresPerDegree(middle * unit.degrees, unit.ellipsoid);
    metres = {metres.east * unit.degrees, metres.north * unit.degrees};
  }
  const double x = std::hypot(t[1] * metres.east, t[4] * metres.north);
  const double y = std::hypot(t[2] * metres.east, t[5] * metres.north);
  if (!std::isfinite(x) || !std::isfinite(y) || x <= 0 || y <= 0) return std::nullopt;
  const std::array<double, 2> spacing = {x, y};
  return unit.degrees > 0 || crs.empty() ? spacing : groundUnderMap(spacing, crs, t, width, height);
}

GridUnit gridUnitOf(const GeoKeys& keys) {
  const uint16_t model = keys.code(kGtModelTypeGeoKey);
  if (model == kModelTypeGeographic) {
    return {angleUnit(keys), 0, statedEllipsoid(keys)};
  }
  if (model == kModelTypeGeocentric) return {};
  if (model == kModelTypeProjected) return {false, gridUnit(keys).value_or(0)};
  // Of a local grid GDAL states no model.
  const GridUnit of_crs = gridUnitOf(wktIn(keys));
  return of_crs.known() ? of_crs : GridUnit{false, statedGridUnit(keys).value_or(0)};
}

GridUnit gridUnitOf(const std::string& crs) {
  if (crs.empty()) return {};
  if (const double degrees = degreesPerUnit(crs); degrees > 0)
    return {degrees, 0, ellipsoidOf(crs)};
  const auto unit = crsUnit(crs, CrsAxis::kHorizontal);
  return {false, unit ? unit->metres : 0};
}

GridUnit gridUnitOf(const std::string& geo_keys, const std::string& crs) {
  const GridUnit stated = gridUnitOf(parseGeoKeys(geo_keys).value_or(GeoKeys{}));
  return stated.known() ? stated : gridUnitOf(crs);
}

ColumnsRound columnsRound(const Georeference& place, uint32_t width) {
  if (!place.geotransform) return ColumnsRound::kNo;
  const double degrees = gridUnitOf(place.geo_keys, place.crs).degrees;
  return columnsRound(PlacedRaster{width, 1, place.geotransform->data()}, degrees);
}

std::array<double, 2> edgeLatitudes(const Georeference& place, uint32_t height) {
  if (!place.geotransform) return {};
  const double degrees = gridUnitOf(place.geo_keys, place.crs).degrees;
  return edgeLatitudes(PlacedRaster{1, height, place.geotransform->data()}, degrees);
}

std::array<double, 2> spacingOf(const tks_info& info) {
  const std::array<double, 2> stated{info.spacing_x, info.spacing_y};
  if (stated[0] > 0 || stated[1] > 0 || !info.has_geotransform) return stated;
  const GridUnit unit = gridUnitOf(info.geo_keys, info.crs);
  return groundSpacing(std::to_array(info.geotransform), info.width, info.height, unit, info.crs)
      .value_or(stated);
}

void setGroundSpacing(HeightFile& heights) {
  if (!heights.geotransform) return;
  const auto spacing = groundSpacing(*heights.geotransform, heights.width, heights.height,
                                     gridUnitOf(heights.crs), heights.crs);
  if (!spacing) return;
  heights.spacing_x = (*spacing)[0];
  heights.spacing_y = (*spacing)[1];
}

}  // namespace tetrakis::tools
