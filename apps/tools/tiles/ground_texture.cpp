// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/ground_texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/tiles/longitude_trail.hpp"
#include "apps/tools/tiles/round_place.hpp"
#include "apps/tools/tiles/terrain_level.hpp"

namespace tetrakis::tools {
namespace {

GeoTransform placeOf(const tks_info& info) {
  GeoTransform place;
  if (info.texture_has_geotransform) {
    std::copy_n(info.texture_geotransform, 6, place.begin());
    return place;
  }
  std::copy_n(info.geotransform, 6, place.begin());
  const double across = (info.width - 1.0) / info.texture_width;
  const double down = (info.height - 1.0) / info.texture_height;
  for (const size_t axis : {0, 3}) {
    place[axis] += (place[axis + 1] + place[axis + 2]) / 2;
    place[axis + 1] *= across;
    place[axis + 2] *= down;
  }
  return place;
}

/// A tile's corners of cells as pixels of the texture; between them the map is nearly bilinear.
class PixelMap {
 public:
  PixelMap(const RasterPlace& place, const GeographicTile& tile) {
    const double cell = tileDegrees(tile.level) / kTileCells;
    for (uint32_t y = 0; y <= kTileCells; ++y) {
      const double latitude = double(uint64_t{tile.y} * kTileCells + y) * cell - 90;
      for (uint32_t x = 0; x <= kTileCells; ++x)
        pixels_.push_back(
            place.pixelAt(double(uint64_t{tile.x} * kTileCells + x) * cell - 180, latitude));
    }
  }

  /// x, y: cells from the south-western corner. On an edge of the tile only corners there count.
  std::array<double, 2> at(double x, double y) const {
    const double left = std::min(std::floor(x), kTileCells - 1.0);
    const double bottom = std::min(std::floor(y), kTileCells - 1.0);
    const double u = x - left, v = y - bottom;
    const auto* const corner =
        &pixels_[static_cast<size_t>(bottom) * kRow + static_cast<size_t>(left)];
    std::array<double, 2> pixel;
    for (size_t k = 0; k < 2; ++k) {
      const double below = corner[0][k] * (1 - u) + corner[1][k] * u;
      const double above = corner[kRow][k] * (1 - u) + corner[kRow + 1][k] * u;
      pixel[k] = below * (1 - v) + above * v;
    }
    return pixel;
  }

 private:
  static constexpr size_t kRow = kTileCells + 1;
  std::vector<std::array<double, 2>> pixels_;
};

/// Bilinear, colours weighted by alpha.
void sample(const ImageFile& image, const SamplesBeside& across, const SamplesBeside& down,
            std::byte* out) {
  const auto [left, right, u] = across;
  const auto [top, bottom, v] = down;
  const bool alpha = image.channels % 2 == 0;
  const uint32_t colours = image.channels - alpha;
  std::array<double, 4> sums{}, plain{};
  double opaque = 0;
  for (const auto& [column, row, weight] : {std::tuple(left, top, (1 - u) * (1 - v)),
                                            {right, top, u * (1 - v)},
                                            {left, bottom, (1 - u) * v},
                                            {right, bottom, u * v}}) {
    const std::byte* const texel =
        &image.data[(size_t{row} * image.width + column) * image.channels];
    const double cover = alpha ? std::to_integer<int>(texel[colours]) / 255.0 * weight : weight;
    opaque += cover;
    for (uint32_t c = 0; c < colours; ++c) {
      sums[c] += cover * std::to_integer<int>(texel[c]);
      plain[c] += weight * std::to_integer<int>(texel[c]);
    }
  }
  const auto rounded = [](double value) {
    return static_cast<std::byte>(std::clamp(std::lround(value), 0L, 255L));
  };
  for (uint32_t c = 0; c < colours; ++c) out[c] = rounded(opaque > 0 ? sums[c] / opaque : plain[c]);
  if (alpha) out[colours] = rounded(255 * opaque);
}

/// Drops an alpha that is 255 everywhere.
void dropOpaqueAlpha(ImageFile& image) {
  const uint32_t channels = image.channels;
  for (size_t i = channels - 1; i < image.data.size(); i += channels)
    if (image.data[i] != std::byte{255}) return;
  size_t kept = 0;
  for (size_t i = 0; i < image.data.size(); ++i)
    if (i % channels != channels - 1) image.data[kept++] = image.data[i];
  image.data.resize(kept);
  image.channels = channels - 1;
}

}  // namespace

GroundTexture::GroundTexture(RasterPlace place, const tks_info& info)
    : place_(std::move(place)),
      width_(info.texture_width),
      height_(info.texture_height),
      coarsest_level_(info.texture_coarsest_level) {}

Result<GroundTexture> GroundTexture::create(const tks_info& info) {
  const std::string crs = info.texture_crs;
  Result<RasterPlace> place = RasterPlace::create(placeOf(info), crs.empty() ? info.crs : crs);
  if (!place.ok()) return place.status();
  GroundTexture texture(std::move(*place), info);
  texture.round_ = columnsRound(texture.place_, texture.width_, texture.height_);
  const auto [x, y] = texture.place_.earthAt(texture.width_ / 2.0, texture.height_ / 2.0);
  constexpr double kNear = 1e-5;
  for (const size_t axis : {0, 1}) {
    const double east = axis == 0 ? kNear : 0, north = axis == 1 ? kNear : 0;
    const auto low = texture.place_.pixelAt(x - east, y - north);
    const auto high = texture.place_.pixelAt(x + east, y + north);
    texture.density_[axis] = std::hypot(high[0] - low[0], high[1] - low[1]) / (2 * kNear);
    if (!std::isfinite(texture.density_[axis]) || !(texture.density_[axis] > 0))
      return Status(TKS_USAGE, "the texture lies beyond the places that its CRS is for");
  }
  return texture;
}

uint32_t GroundTexture::mipFor(const std::array<double, 2>& degrees) const {
  const double ratio = std::min(density_[0] * degrees[0], density_[1] * degrees[1]);
  const double level = std::floor(std::log2(std::max(ratio, 1.0)));
  return static_cast<uint32_t>(std::min<double>(level, coarsest_level_));
}

/// Places along the border suffice: no pole is inside.
Result<GeographicBounds> GroundTexture::bounds() const {
  constexpr int kPlaces = 64;
  const double none = std::numeric_limits<double>::infinity();
  GeographicBounds bounds{none, none, -none, -none};
  std::array<LongitudeTrail, 4> sides;
  bool apart = false;
  for (int i = 0; i <= kPlaces; ++i) {
    const double x = double(width_) * i / kPlaces, y = double(height_) * i / kPlaces;
    size_t side = 0;
    for (const auto& [column, row] :
         {std::pair(x, 0.0), {x, double(height_)}, {0.0, y}, {double(width_), y}}) {
      const auto [longitude, latitude] = place_.earthAt(column, row);
      apart = sides[side++].comesApart(longitude) || apart;
      bounds = {std::min(bounds.west, longitude), std::min(bounds.south, latitude),
                std::max(bounds.east, longitude), std::max(bounds.north, latitude)};
    }
  }
  if (round_ > 0) {
    bounds.west = -180;
    bounds.east = 180;
  } else if (apart)
    return Status(TKS_USAGE,
                  "the texture lies on both sides of the antimeridian: cut it there and make tiles "
                  "of each part");
  constexpr double kSlack = 1e-6;
  if (bounds.west >= -180 - kSlack && bounds.east <= 180 + kSlack && bounds.south >= -90 - kSlack &&
      bounds.north <= 90 + kSlack && bounds.west < bounds.east && bounds.south < bounds.north)
    return bounds;
  return Status(TKS_USAGE, "the texture lies beyond the places that its CRS is for");
}

void GroundTexture::use(ImageFile mip, uint32_t level) {
  if (mip.hasFurtherColour()) mip = withoutFurtherColour(mip);
  mip_ = mip.sample == TKS_U8 ? std::move(mip) : reducedTo8Bits(mip);
  level_ = level;
}

SamplesBeside GroundTexture::columnsAt(double pixel) const {
  const double scale = std::ldexp(1, -static_cast<int>(level_)), at = (pixel - 0.5) * scale;
  if (round_ > 0 && std::isfinite(at)) return samplesRound(at, mip_.width, round_ * scale);
  return samplesBeside(at, mip_.width);
}

ImageFile GroundTexture::piece(const GeographicTile& tile, const TexelGrid& grid,
                               TexelPlaces places, bool cut) const {
  const PixelMap map(place_, tile);
  const bool added = cut && mip_.channels % 2 != 0;
  ImageFile piece{grid.across, grid.down, mip_.channels + added, TKS_U8, {}};
  piece.data.assign(size_t{grid.across} * grid.down * piece.channels, std::byte{255});
  const auto cellOf = [places](uint32_t texel, uint32_t texels) {
    if (places == TexelPlaces::kAreas) return (texel + 0.5) / texels * kTileCells;
    return double(texel) / (texels - 1) * kTileCells;
  };
  const double scale = std::ldexp(1, -static_cast<int>(level_));
  for (uint32_t row = 0; row < grid.down; ++row) {
    const double y = cellOf(grid.down - 1 - row, grid.down);
    for (uint32_t column = 0; column < grid.across; ++column) {
      const auto [x_pixel, y_pixel] = map.at(cellOf(column, grid.across), y);
      std::byte* const out = &piece.data[(size_t{row} * grid.across + column) * piece.channels];
      sample(mip_, columnsAt(x_pixel), samplesBeside((y_pixel - 0.5) * scale, mip_.height), out);
      const bool across = round_ > 0 || (x_pixel >= 0 && x_pixel <= width_);
      const bool inside = across && y_pixel >= 0 && y_pixel <= height_;
      if (cut && !inside) out[piece.channels - 1] = std::byte{0};
    }
  }
  if (piece.channels % 2 == 0) dropOpaqueAlpha(piece);
  return piece;
}

}  // namespace tetrakis::tools
