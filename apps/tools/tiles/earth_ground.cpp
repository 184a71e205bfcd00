// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/earth_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/tools/tiles/longitude_trail.hpp"

namespace tetrakis::tools {
namespace {

/// The mean of the valid samples around a place by their bilinear weights; NaN if there is none.
float bilinear(const LevelSurface& surface, double x, double y) {
  const double left = std::clamp(std::floor(x), 0.0, std::max(surface.width - 2.0, 0.0));
  const double top = std::clamp(std::floor(y), 0.0, std::max(surface.height - 2.0, 0.0));
  double sum = 0, weights = 0;
  for (const double row : {top, top + 1}) {
    for (const double column : {left, left + 1}) {
      const double weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
      if (!(weight > 0) || column >= surface.width || row >= surface.height) continue;
      const float height =
          surface.heights[static_cast<size_t>(row) * surface.width + static_cast<size_t>(column)];
      if (std::isnan(height)) continue;
      sum += weight * height;
      weights += weight;
    }
  }
  return weights > 0 ? static_cast<float>(sum / weights) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Result<EarthGround> EarthGround::create(const tks_info& info) {
  if (!info.has_heights) return Status(TKS_USAGE, "the stream has no heights");
  if (info.width < 2 || info.height < 2)
    return Status(TKS_USAGE, "heights of one column or row have no area to make tiles of");
  const std::string crs = info.crs;
  if (!info.has_geotransform || crs.empty())
    return Status(TKS_USAGE,
                  "the stream does not say where on Earth its heights lie: encode a "
                  "GeoTIFF, or a world file with --crs");
  GeoTransform transform;
  std::copy_n(info.geotransform, 6, transform.begin());
  Result<RasterPlace> place = RasterPlace::create(transform, crs);
  if (!place.ok()) return place.status();
  EarthGround ground(std::move(*place), info.width, info.height);
  if (const Status status = ground.findBounds(); !status.ok()) return status;
  const GeographicBounds& b = ground.bounds_;
  constexpr double kMetresPerDegree = 111195;
  const double metres = std::min(info.spacing_x, info.spacing_y), degrees = b.north - b.south;
  // Samples that lie at a pole are no distance apart along their parallel.
  const double least = degrees / (double(info.width) + info.height);
  ground.spacing_ = metres > 0 ? std::max(metres / kMetresPerDegree, least) : degrees / info.height;
  return ground;
}

/// By 65 x 65 places from edge to edge. Around a pole, and where ground crosses the antimeridian,
/// longitudes of neighbours come apart; those of a grid in degrees go on beyond 180.
Status EarthGround::findBounds() {
  constexpr int kPlaces = 64;
  const Status split(TKS_USAGE,
                     "the heights hold a pole or lie on both sides of the antimeridian: cut them "
                     "there and make tiles of each part");
  std::array<LongitudeTrail, kPlaces + 1> rows;
  const double none = std::numeric_limits<double>::infinity();
  bounds_ = {none, none, -none, -none};
  for (int i = 0; i <= kPlaces; ++i) {
    LongitudeTrail down;
    for (int j = 0; j <= kPlaces; ++j) {
      const double c = double(width_) * i / kPlaces, r = double(height_) * j / kPlaces;
      const auto [x, y] = place_.earthAt(c, r);
      if (!std::isfinite(x) || !std::isfinite(y))
        return {TKS_USAGE, "parts of the heights lie beyond the places that their CRS is for"};
      if (rows[j].comesApart(x) || down.comesApart(x)) return split;
      bounds_.west = std::min(bounds_.west, x);
      bounds_.east = std::max(bounds_.east, x);
      bounds_.south = std::min(bounds_.south, y);
      bounds_.north = std::max(bounds_.north, y);
    }
  }
  // Grids of degrees with samples on a pole, or on the antimeridian, reach half a sample beyond it.
  constexpr double kSlack = 1e-6;
  const double width = bounds_.east - bounds_.west;
  const double column = width / width_ / 2 + kSlack;
  const double row = (bounds_.north - bounds_.south) / height_ / 2 + kSlack;
  west_ = bounds_.west;
  if (bounds_.west >= 180 - column) {
    bounds_.west -= 360;
    bounds_.east -= 360;
  } else if (bounds_.west >= -column && bounds_.east > 180 + column && width > 180 &&
             width <= 360 + 2 * column) {
    bounds_.west = -180;
    bounds_.east = 180;
  }
  const bool on_earth = bounds_.west >= -180 - column && bounds_.east <= 180 + column &&
                        bounds_.south >= -90 - row && bounds_.north <= 90 + row;
  bounds_ = {std::max(bounds_.west, -180.0), std::max(bounds_.south, -90.0),
             std::min(bounds_.east, 180.0), std::min(bounds_.north, 90.0)};
  return on_earth ? Status() : split;
}

void EarthGround::sampleParallel(const LevelSurface& surface, double latitude,
                                 std::span<const double> longitudes,
                                 std::span<float> heights) const {
  const double scale = std::ldexp(1, -static_cast<int>(surface.level));
  for (size_t i = 0; i < longitudes.size(); ++i) {
    heights[i] = std::numeric_limits<float>::quiet_NaN();
    // Far from its place a projection may give anything.
    if (longitudes[i] < bounds_.west || longitudes[i] > bounds_.east || latitude < bounds_.south ||
        latitude > bounds_.north)
      continue;
    const auto [column, row] = place_.pixelAt(unwrapped(longitudes[i]), latitude);
    if (!(column >= 0 && column <= width_ && row >= 0 && row <= height_)) continue;
    // From areas to the middles of samples, of which the outer ones count up to the edge.
    const double across = std::clamp((column - 0.5) * scale, 0.0, surface.width - 1.0);
    const double down = std::clamp((row - 0.5) * scale, 0.0, surface.height - 1.0);
    heights[i] = bilinear(surface, across, down);
  }
}

}  // namespace tetrakis::tools
