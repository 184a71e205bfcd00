// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/texture_place.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "apps/tools/files/place/raster_place.hpp"

namespace tetrakis::tools {

namespace {

using Place = std::array<double, 2>;
using PlaceAt = std::function<Place(double column, double row)>;

std::optional<GeoTransform> transformOf(int known, const double (&transform)[6]) {
  if (!known) return std::nullopt;
  GeoTransform out;
  std::copy_n(transform, out.size(), out.begin());
  return out;
}

PlaceAt covering(const PlacedRaster& heights, const PlacedRaster& texture) {
  const auto scale = [](uint32_t texels, uint32_t samples) {
    return static_cast<double>(texels) / std::max(samples - 1., 1.);
  };
  const double across = scale(texture.width, heights.width);
  const double down = scale(texture.height, heights.height);
  return [=](double column, double row) { return Place{column * across, row * down}; };
}

/// Both in one reference system. A geotransform is that of corners of pixels; samples lie in their
/// middles.
std::optional<PlaceAt> byTransforms(const GeoTransform& from, const GeoTransform& to) {
  const double determinant = to[1] * to[5] - to[2] * to[4];
  if (!std::isnormal(determinant)) return std::nullopt;
  return [=](double column, double row) {
    const double x = from[0] + (column + 0.5) * from[1] + (row + 0.5) * from[2] - to[0];
    const double y = from[3] + (column + 0.5) * from[4] + (row + 0.5) * from[5] - to[3];
    return Place{(to[5] * x - to[2] * y) / determinant, (to[1] * y - to[4] * x) / determinant};
  };
}

std::optional<PlaceAt> byProjection(const PlacedRaster& heights, const PlacedRaster& texture) {
  Result<RasterPlace> from = RasterPlace::create(*heights.transform, heights.crs);
  Result<RasterPlace> to = RasterPlace::create(*texture.transform, texture.crs);
  if (!from.ok() || !to.ok()) return std::nullopt;
  const auto places =
      std::make_shared<const std::pair<RasterPlace, RasterPlace>>(*std::move(from), *std::move(to));
  return [places](double column, double row) {
    const auto [longitude, latitude] = places->first.earthAt(column + 0.5, row + 0.5);
    return places->second.pixelAt(longitude, latitude);
  };
}

std::optional<PlaceAt> byGeoreference(const PlacedRaster& heights, const PlacedRaster& texture) {
  if (!heights.transform || !texture.transform) return std::nullopt;
  if (heights.crs == texture.crs) return byTransforms(*heights.transform, *texture.transform);
  return byProjection(heights, texture);
}

}  // namespace

PlacedRaster PlacedRaster::heightsOf(const tks_info& info) {
  PlacedRaster raster;
  // Heights on a cube lie where their grid does.
  raster.width = info.grid_width > 0 ? info.grid_width : info.width;
  raster.height = info.grid_width > 0 ? info.grid_height : info.height;
  raster.transform = transformOf(info.has_geotransform, info.geotransform);
  raster.crs = info.crs;
  return raster;
}

PlacedRaster PlacedRaster::textureOf(const tks_info& info) {
  PlacedRaster raster;
  raster.width = info.texture_width;
  raster.height = info.texture_height;
  raster.transform = transformOf(info.texture_has_geotransform, info.texture_geotransform);
  raster.crs = *info.texture_crs != 0 ? info.texture_crs : info.crs;
  raster.round = info.texture_domain == TKS_DOMAIN_CYLINDER;
  return raster;
}

TexturePlace::TexturePlace(const PlacedRaster& heights, const PlacedRaster& texture)
    : width_(texture.width),
      height_(texture.height),
      round_(texture.round),
      texel_at_(covering(heights, texture)) {
  std::optional<PlaceAt> placed = byGeoreference(heights, texture);
  if (!placed) return;
  const PlaceAt covered = std::exchange(texel_at_, *std::move(placed));
  // How far the corners lie from there, in samples.
  const Place sample = covered(1, 1);  // in texels
  const auto near = [&](const Place& here, const Place& there) {
    return std::abs(here[0] - there[0]) <= 1.01 * sample[0] &&
           std::abs(here[1] - there[1]) <= 1.01 * sample[1];
  };
  std::array<Place, 4> corners, covered_corners;
  for (size_t i = 0; i < corners.size(); ++i) {
    const double column = i % 2 ? heights.width - 1. : 0, row = i / 2 ? heights.height - 1. : 0;
    corners[i] = texelAt(column, row);
    covered_corners[i] = covered(column, row);
    own_ |= !near(corners[i], covered_corners[i]);
  }
  turned_ =
      own_ && std::is_permutation(corners.begin(), corners.end(), covered_corners.begin(), near);
}

/// The border of the rectangle says what lies in it, whatever the projection bends.
std::optional<tks_window> TexturePlace::texelsOver(const tks_window& samples) const {
  constexpr int kParts = 16;
  Place low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
  const auto look = [&](double across, double down) {
    const Place texel = texelAt(samples.x - 0.5 + across * samples.width / kParts,
                                samples.y - 0.5 + down * samples.height / kParts);
    for (size_t i = 0; i < 2; ++i) {
      if (!std::isfinite(texel[i])) continue;
      low[i] = std::min(low[i], texel[i]);
      high[i] = std::max(high[i], texel[i]);
    }
  };
  for (int part = 0; part <= kParts; ++part) {
    look(part, 0);
    look(part, kParts);
    look(0, part);
    look(kParts, part);
  }
  const Place sides = {static_cast<double>(width_), static_cast<double>(height_)};
  if (round_) {
    const double turns = std::floor(std::round(low[0]) / sides[0]);
    low[0] -= turns * sides[0];
    high[0] -= turns * sides[0];
  }
  std::array<uint32_t, 2> first, count;
  for (size_t i = 0; i < 2; ++i) {
    if (!(low[i] < sides[i] && high[i] > 0)) return std::nullopt;
    const double begin = std::clamp(std::round(low[i]), 0., sides[i] - 1);
    const double last = round_ && i == 0 ? begin + sides[0] : sides[i];
    const double end = std::clamp(std::round(high[i]), begin + 1, last);
    first[i] = static_cast<uint32_t>(begin);
    count[i] = static_cast<uint32_t>(end - begin);
  }
  return tks_window{first[0], first[1], count[0], count[1]};
}

}  // namespace tetrakis::tools
