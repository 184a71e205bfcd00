// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/raster_place.hpp"

#include <cmath>
#include <optional>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace {

constexpr const char* kLongitudeLatitude = "EPSG:4326";

/// From coordinates back to columns and rows.
std::optional<GeoTransform> inverseOf(const GeoTransform& t) {
  const double determinant = t[1] * t[5] - t[2] * t[4];
  if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return std::nullopt;
  GeoTransform inverse{0, t[5] / determinant,  -t[2] / determinant,
                       0, -t[4] / determinant, t[1] / determinant};
  inverse[0] = -(t[0] * inverse[1] + t[3] * inverse[2]);
  inverse[3] = -(t[0] * inverse[4] + t[3] * inverse[5]);
  return inverse;
}

ProjObject toLongitudeLatitude(PJ_CONTEXT* context, const std::string& crs) {
  const ProjObject from = horizontalPart(context, findCrs(context, kLongitudeLatitude));
  const ProjObject to = horizontalPart(context, findCrs(context, crs));
  return from && to ? transformation(context, from.get(), to.get()) : nullptr;
}

std::array<double, 2> applied(const GeoTransform& t, double a, double b) {
  return {t[0] + a * t[1] + b * t[2], t[3] + a * t[4] + b * t[5]};
}

}  // namespace

Result<RasterPlace> RasterPlace::create(const GeoTransform& transform, const std::string& crs) {
  RasterPlace place;
  place.transform_ = transform;
  const auto inverse = inverseOf(transform);
  if (!inverse) return Status(TKS_USAGE, "the geotransform of the stream has no inverse");
  place.inverse_ = *inverse;
  place.context_ = quietContext();
  if (place.context_) place.transformation_ = toLongitudeLatitude(place.context_.get(), crs);
  if (!place.transformation_)
    return Status(TKS_USAGE,
                  "PROJ cannot turn " + quoted(crs.substr(0, 80)) + " into longitude and latitude");
  return place;
}

std::array<double, 2> RasterPlace::pixelAt(double longitude, double latitude) const {
  const PJ_COORD place =
      proj_trans(transformation_.get(), PJ_FWD, proj_coord(longitude, latitude, 0, HUGE_VAL));
  return applied(inverse_, place.xy.x, place.xy.y);
}

std::array<double, 2> RasterPlace::earthAt(double column, double row) const {
  const auto [x, y] = applied(transform_, column, row);
  const PJ_COORD found = proj_trans(transformation_.get(), PJ_INV, proj_coord(x, y, 0, HUGE_VAL));
  return {found.xy.x, found.xy.y};
}

}  // namespace tetrakis::tools
