// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/map_scale.hpp"

#include <algorithm>
#include <cmath>

#include "apps/tools/files/place/proj_objects.hpp"

namespace tetrakis::tools {
namespace {

constexpr double kAsGoodAsTrue = 0.01;

Ellipsoid ellipsoidOf(PJ_CONTEXT* context, const PJ* crs) {
  Ellipsoid known;
  const ProjObject found(crs != nullptr ? proj_get_ellipsoid(context, crs) : nullptr);
  double semi_major = 0, inverse_flattening = 0;
  if (!found ||
      !proj_ellipsoid_get_parameters(context, found.get(), &semi_major, nullptr, nullptr,
                                     &inverse_flattening) ||
      !(semi_major > 0))
    return known;
  return {semi_major, inverse_flattening > 0 ? 1 / inverse_flattening : 0};
}

/// The ground under a map: metres between places of it that are near each other.
class Ground {
 public:
  Ground(PJ_CONTEXT* context, const PJ* map) : ellipsoid_(ellipsoidOf(context, map)) {
    const ProjObject degrees(proj_crs_get_geodetic_crs(context, map));
    if (degrees) to_degrees_ = transformation(context, map, degrees.get());
  }

  bool known() const { return to_degrees_ != nullptr; }
  double distance(double x, double y, double dx, double dy) const {
    const PJ_COORD from = degreesAt(x, y), to = degreesAt(x + dx, y + dy);
    const MetresPerDegree metres = metresPerDegree(from.xy.y, ellipsoid_);
    return std::hypot(std::remainder(to.xy.x - from.xy.x, 360) * metres.east,
                      (to.xy.y - from.xy.y) * metres.north);
  }

 private:
  PJ_COORD degreesAt(double x, double y) const {
    return proj_trans(to_degrees_.get(), PJ_FWD, proj_coord(x, y, 0, HUGE_VAL));
  }

  Ellipsoid ellipsoid_;
  ProjObject to_degrees_;
};

bool isTrue(double of_map, double of_ground) {
  return std::abs(of_map - of_ground) <= kAsGoodAsTrue * of_ground;
}

bool isDistance(double metres) {
  return std::isfinite(metres) && metres > 0;
}

}  // namespace

Ellipsoid ellipsoidOf(const std::string& crs) {
  const ProjContext context = quietContext();
  if (!context) return {};
  return ellipsoidOf(context.get(),
                     horizontalPart(context.get(), findCrs(context.get(), crs)).get());
}

std::array<double, 2> groundUnderMap(const std::array<double, 2>& of_map, const std::string& crs,
                                     const GeoTransform& t, uint32_t width, uint32_t height) {
  const ProjContext context = quietContext();
  if (!context) return of_map;
  const ProjObject map = horizontalPart(context.get(), findCrs(context.get(), crs));
  if (!map || proj_get_type(map.get()) != PJ_TYPE_PROJECTED_CRS) return of_map;
  const Ground ground(context.get(), map.get());
  if (!ground.known()) return of_map;
  const double column = width / 2.0, row = height / 2.0;
  const double x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] + row * t[5];
  const std::array<double, 2> found = {ground.distance(x, y, t[1], t[4]),
                                       ground.distance(x, y, t[2], t[5])};
  const bool is_true = isTrue(of_map[0], found[0]) && isTrue(of_map[1], found[1]);
  return is_true || !isDistance(found[0]) || !isDistance(found[1]) ? of_map : found;
}

}  // namespace tetrakis::tools
