// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/earth_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/tiles/longitude_trail.hpp"
#include "apps/tools/tiles/round_place.hpp"

namespace tetrakis::tools {
namespace {

/// The mean of the valid samples around a place by their bilinear weights; NaN if there is none.
float bilinear(const LevelSurface& surface, const SamplesBeside& across,
               const SamplesBeside& down) {
  double sum = 0, weights = 0;
  for (const auto& [row, height] :
       {std::pair(down.first, 1 - down.share), {down.second, down.share}}) {
    for (const auto& [column, width] :
         {std::pair(across.first, 1 - across.share), {across.second, across.share}}) {
      const double weight = width * height;
      const float sample = surface.heights[size_t{row} * surface.width + column];
      if (!(weight > 0) || std::isnan(sample)) continue;
      sum += weight * sample;
      weights += weight;
    }
  }
  return weights > 0 ? static_cast<float>(sum / weights) : std::numeric_limits<float>::quiet_NaN();
}

/// Of the samples that are no voids; NaN if there are none.
double meanOfRow(const LevelSurface& surface, uint32_t row) {
  double sum = 0, count = 0;
  for (uint32_t column = 0; column < surface.width; ++column) {
    const float sample = surface.heights[size_t{row} * surface.width + column];
    if (std::isnan(sample)) continue;
    sum += sample;
    ++count;
  }
  return sum / count;
}

}  // namespace

/// Weights 1, 2, 1 along rows and columns.
LevelSurface coarser(const LevelSurface& surface, bool round) {
  LevelSurface half{{}, (surface.width + 1) / 2, (surface.height + 1) / 2, surface.level + 1};
  const auto beside = [](uint32_t at, uint32_t count, bool around) {
    const uint32_t before = at > 0 ? at - 1 : around ? count - 1 : 0;
    return std::array{before, at, at, at + 1 < count ? at + 1 : around ? 0 : at};
  };
  for (uint32_t y = 0; y < half.height; ++y) {
    for (uint32_t x = 0; x < half.width; ++x) {
      double sum = 0, count = 0;
      for (const uint32_t row : beside(2 * y, surface.height, false)) {
        for (const uint32_t column : beside(2 * x, surface.width, round)) {
          const float height = surface.heights[size_t{row} * surface.width + column];
          if (std::isnan(height)) continue;
          sum += height;
          ++count;
        }
      }
      half.heights.push_back(static_cast<float>(sum / count));
    }
  }
  return half;
}

Result<EarthGround> EarthGround::create(const tks_info& info) {
  if (!info.has_heights) return Status(TKS_USAGE, "the stream has no heights");
  if (info.domain == TKS_DOMAIN_FOREST && !isGridOnCube(info))
    return Status(TKS_USAGE, "the heights lie on patches that no geographic grid was put on");
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
  const Extent extent = shownHeights(info);
  EarthGround ground(std::move(*place), extent.width, extent.height);
  if (const Status status = ground.findBounds(); !status.ok()) return status;
  const GeographicBounds& b = ground.bounds_;
  constexpr double kMetresPerDegree = 111195;
  // A cube tells the spacing of its own samples.
  const double metres = isGridOnCube(info) ? 0 : std::min(info.spacing_x, info.spacing_y);
  const double degrees = b.north - b.south;
  // Samples that lie at a pole are no distance apart along their parallel.
  const double least = degrees / (double(extent.width) + extent.height);
  ground.spacing_ =
      metres > 0 ? std::max(metres / kMetresPerDegree, least) : degrees / extent.height;
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
  round_ = tools::columnsRound(place_, width_, height_);
  if (round_ > 0) {
    bounds_.west = -180;
    bounds_.east = 180;
  } else if (bounds_.west >= 180 - column) {
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
  for (const double pole : {-90.0, 90.0}) {
    const bool reached = pole < 0 ? bounds_.south < pole + kSlack : bounds_.north > pole - kSlack;
    if (round_ > 0 && reached) pole_rows_[pole > 0] = place_.pixelAt(west_, pole)[1];
  }
  return on_earth ? Status() : split;
}

EarthGround::PoleShare EarthGround::poleShare(const LevelSurface& surface, double latitude,
                                              double down) const {
  const std::optional<double>& pole = pole_rows_[latitude > 0];
  if (!pole) return {};
  const double scale = std::ldexp(1, -static_cast<int>(surface.level));
  const uint32_t row = *pole < height_ / 2.0 ? 0 : surface.height - 1;
  const double beyond = (*pole - 0.5) * scale - row;
  const bool is_pole = std::abs(latitude) >= 90;
  const double share = is_pole                ? 1
                       : std::abs(beyond) > 0 ? std::clamp((down - row) / beyond, 0.0, 1.0)
                                              : 0;
  const double mean = share > 0 ? meanOfRow(surface, row) : 0;
  return std::isnan(mean) ? PoleShare{} : PoleShare{share, mean};
}

void EarthGround::sampleParallel(const LevelSurface& surface, double latitude,
                                 std::span<const double> longitudes,
                                 std::span<float> heights) const {
  const double scale = std::ldexp(1, -static_cast<int>(surface.level));
  std::optional<PoleShare> pole;
  for (size_t i = 0; i < longitudes.size(); ++i) {
    heights[i] = std::numeric_limits<float>::quiet_NaN();
    // Far from its place a projection may give anything.
    if (longitudes[i] < bounds_.west || longitudes[i] > bounds_.east || latitude < bounds_.south ||
        latitude > bounds_.north)
      continue;
    const auto [column, row] = place_.pixelAt(unwrapped(longitudes[i]), latitude);
    constexpr double kSlack = 1e-6;  // at a pole
    if (!(row >= -kSlack && row <= height_ + kSlack) ||
        !(round_ > 0 || (column >= 0 && column <= width_)))
      continue;
    // From areas to the middles of samples, of which the outer ones count up to the edge.
    const double across = (column - 0.5) * scale, down = (row - 0.5) * scale;
    if (!pole) pole = poleShare(surface, latitude, down);
    const SamplesBeside columns = round_ > 0 ? samplesRound(across, surface.width, round_ * scale)
                                             : samplesBeside(across, surface.width);
    heights[i] = bilinear(surface, columns, samplesBeside(down, surface.height));
    if (pole->share == 1 || (pole->share > 0 && !std::isnan(heights[i])))
      heights[i] = pole->of(heights[i]);
  }
}

}  // namespace tetrakis::tools
