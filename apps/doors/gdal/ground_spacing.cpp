// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/ground_spacing.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace tetrakis::gdal {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Metres {
  double x, y;

  bool areDistances() const { return std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0; }
};

/// A grid of a building site, say: straight axes that lie nowhere on Earth. Their unit may be any.
bool isLocalGrid(const OGRSpatialReference& system) {
  constexpr double kAlike = 1e-9;
  return system.IsLocal() && std::abs(system.GetLinearUnits() - kDegree) > kAlike;
}

/// How many metres a radian has to the east and to the north, by the radii of curvature of the
/// ellipsoid. latitude: in radians; beyond the poles there are 0 metres.
Metres metresPerRadian(const OGRSpatialReference& system, double latitude) {
  if (!(std::abs(latitude) < std::numbers::pi / 2)) return {0, 0};
  const double axis = system.GetSemiMajor(), inverse_flattening = system.GetInvFlattening();
  const double flattening = inverse_flattening > 0 ? 1 / inverse_flattening : 0;
  const double e2 = flattening * (2 - flattening);
  const double w = std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  return {axis / w * std::cos(latitude), axis * (1 - e2) / (w * w * w)};
}

/// The ground under a map: metres between places of it that are near each other.
class Ground {
 public:
  explicit Ground(const OGRSpatialReference& map) : map_(map) {
    map_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRSpatialReference> angles(map.CloneGeogCS());
    if (!angles) return;
    angles->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    radians_ = angles->GetAngularUnits();
    to_angles_.reset(OGRCreateCoordinateTransformation(&map_, angles.get()));
  }

  /// NaN where it is unknown.
  double distance(double x, double y, double dx, double dy) const {
    double xs[] = {x, x + dx}, ys[] = {y, y + dy};
    if (!to_angles_ || !to_angles_->Transform(2, xs, ys)) return std::nan("");
    const Metres metres = metresPerRadian(map_, ys[0] * radians_);
    const double east = std::remainder((xs[1] - xs[0]) * radians_, 2 * std::numbers::pi);
    return std::hypot(east * metres.x, (ys[1] - ys[0]) * radians_ * metres.y);
  }

 private:
  OGRSpatialReference map_;
  double radians_ = kDegree;
  std::unique_ptr<OGRCoordinateTransformation> to_angles_;
};

bool isTrue(double of_map, double of_ground) {
  constexpr double kAsGoodAsTrue = 0.01;
  return std::abs(of_map - of_ground) <= kAsGoodAsTrue * of_ground;
}

/// The map's own metres where they are true, or nobody knows better.
Metres groundUnder(const OGRSpatialReference& map, double x, double y, const double* t,
                   const Metres& of_map) {
  const CPLErrorStateBackuper errors;  // nobody asked for the ground: a failure stays silent
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  const Ground ground(map);
  const Metres found = {ground.distance(x, y, t[1], t[4]), ground.distance(x, y, t[2], t[5])};
  const bool is_true = isTrue(of_map.x, found.x) && isTrue(of_map.y, found.y);
  return is_true || !found.areDistances() ? of_map : found;
}

Metres between(const double* t, const Metres& unit) {
  return {std::hypot(t[1] * unit.x, t[4] * unit.y), std::hypot(t[2] * unit.x, t[5] * unit.y)};
}

/// Both 0 where they are unknown.
Metres spacingOf(const OGRSpatialReference& system, const tks_heights& heights) {
  const double* const t = heights.geotransform;
  const double column = heights.width / 2.0, row = heights.height / 2.0;
  const double x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] + row * t[5];
  if (system.IsGeographic()) {
    const double radians = system.GetAngularUnits();
    const Metres radian = metresPerRadian(system, y * radians);
    return between(t, {radians * radian.x, radians * radian.y});
  }
  const double metres = system.GetLinearUnits();
  if (system.IsProjected()) return groundUnder(system, x, y, t, between(t, {metres, metres}));
  return isLocalGrid(system) ? between(t, {metres, metres}) : Metres{0, 0};
}

}  // namespace

void setGroundSpacing(const OGRSpatialReference* system, tks_heights& heights) {
  if (system == nullptr || !heights.has_geotransform) return;
  const Metres spacing = spacingOf(*system, heights);
  if (!spacing.areDistances()) return;
  heights.spacing_x = spacing.x;
  heights.spacing_y = spacing.y;
}

}  // namespace tetrakis::gdal
