// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/awkward_case.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "tests/awkward/awkward_forest.hpp"
#include "tests/awkward/awkward_ground.hpp"

namespace tetrakis::test {

namespace {

/// Around multiples of region sides, tiny, or anything.
uint32_t awkwardSide(Dice& dice, uint32_t most) {
  if (most <= 2) return 2;
  switch (dice.below(4)) {
    case 0:
      return std::min(most, 2 + dice.below(8));
    case 1:
      return 2 + dice.below(most - 1);
    default: {
      const uint32_t border = (1 + dice.below(5)) << (4 + dice.below(5));
      return std::clamp(border + dice.below(4) - 2, 2u, most);
    }
  }
}

/// Polygons, single samples or everything become nodata or NaN.
void punch(Dice& dice, AwkwardCase& c) {
  samples::Raster& raster = c.heights;
  if (dice.once(2)) {
    const Bounds bounds = boundsOf(raster.sample);
    // The last one no integer type holds: it meets no sample.
    const std::array<double, 4> values = {scaled(raster.sample, dice.below(65536)), bounds.low,
                                          raster.sample == TKS_U8 ? 0.0 : bounds.high, -9999.5};
    c.nodata = dice.of(values);
  }
  const bool nan = raster.sample == TKS_F32 && dice.once(2);
  if (!c.nodata && !nan) return;
  const uint32_t seed = static_cast<uint32_t>(dice.next()), share = dice.below(6);
  for (uint32_t y = 0; y < raster.height; ++y) {
    for (uint32_t x = 0; x < raster.width; ++x) {
      const bool hole = share < 3    ? samples::valueNoise(x, y, 3 + share, seed) < 20000 * share
                        : share == 3 ? samples::hash(x, y, seed) % 10 != 0
                                     : samples::hash(x, y, seed) % 64 == 0;
      const bool held = raster.sample == TKS_F32 || *c.nodata != -9999.5;
      if (!hole || !held) continue;
      storeSample(raster, size_t{y} * raster.width + x,
                  nan ? std::numeric_limits<double>::quiet_NaN() : *c.nodata);
    }
  }
}

std::string aim(Dice& dice, AwkwardCase& c) {
  tks_encode_options& o = c.options;
  o.size = sizeof o;
  const uint32_t target = dice.below(5);
  if (target <= 1) {
    o.lossless = 1;
    return "lossless";
  }
  if (target == 2) {
    o.bytes = 100 + dice.below(static_cast<uint32_t>(c.heights.data.size()) + 400);
    return "bytes " + std::to_string(o.bytes);
  }
  if (target == 3) {
    o.psnr = 5 + dice.below(120);
    return "psnr " + std::to_string(o.psnr);
  }
  constexpr std::array<double, 8> kBounds = {1e-5, 0.001, 0.3, 0.5, 1, 1.6, 21, 700};
  o.max_error = dice.of(kBounds);
  return "max_error " + std::to_string(o.max_error);
}

void addTexture(Dice& dice, AwkwardCase& c, uint32_t most_samples) {
  samples::Recipe recipe;
  recipe.pattern = static_cast<samples::Pattern>(dice.below(6));
  recipe.width = awkwardSide(dice, 130);
  recipe.height = awkwardSide(dice, std::max(2u, std::min(130u, most_samples / recipe.width)));
  recipe.channels = 1 + dice.below(4);
  recipe.sample = dice.once(4) ? TKS_U16 : TKS_U8;
  recipe.seed = static_cast<uint32_t>(dice.next());
  c.texture = samples::make(recipe);
}

std::string described(const AwkwardCase& c) {
  const auto extent = [](const samples::Raster& raster) {
    return std::to_string(raster.width) + " x " + std::to_string(raster.height);
  };
  std::string text = "type " + std::to_string(c.heights.sample) + ", " + extent(c.heights) +
                     ", regions " + std::to_string(c.options.regions);
  if (c.nodata) text += ", nodata " + std::to_string(*c.nodata);
  if (c.texture) text += ", texture " + extent(*c.texture);
  if (c.domain == TKS_DOMAIN_CYLINDER) text += ", cylinder";
  if (c.domain == TKS_DOMAIN_FOREST)
    text += ", forest of " + std::to_string(c.sides.size() / 4) + " patches of depth " +
            std::to_string(c.depth);
  return c.grid ? text + ", round the Earth" : text;
}

}  // namespace

tks_heights AwkwardCase::input() const {
  tks_heights h = heights.heights();
  h.has_nodata = nodata.has_value();
  h.nodata = nodata.value_or(0);
  h.domain = domain;
  h.forest = {depth, static_cast<uint32_t>(sides.size() / 4), sides.data()};
  if (!grid) return h;
  h.has_geotransform = 1;
  std::copy_n(grid->geotransform, 6, h.geotransform);
  if (domain != TKS_DOMAIN_FOREST) return h;
  h.grid_width = grid->width;
  h.grid_height = grid->height;
  return h;
}

tks_image AwkwardCase::picture() const {
  tks_image image = texture->image();
  image.domain = domain;
  image.forest = {texture_depth, static_cast<uint32_t>(sides.size() / 4), sides.data()};
  return image;
}

AwkwardCase awkwardCase(uint64_t seed, uint32_t most_samples) {
  Dice dice(seed);
  AwkwardCase c;
  const uint32_t width = awkwardSide(dice, std::min(most_samples / 2, 1500u));
  const uint32_t rows = awkwardSide(dice, std::max(2u, std::min(most_samples / width, 1500u)));
  const uint32_t height = dice.once(12) ? 1 : rows;
  const auto kind = static_cast<Kind>(dice.below(static_cast<uint32_t>(Kind::kCount)));
  c.heights =
      dice.once(2) ? groundOf(dice, kind, width, height) : groundOf(dice, kind, height, width);
  if (dice.once(3)) punch(dice, c);
  const std::string target = aim(dice, c);
  constexpr std::array<uint32_t, 6> kRegions = {0, 1, 16, 16, 32, 64};
  c.options.regions = dice.of(kRegions);
  c.options.threads = 1 + dice.below(2);
  c.options.index = dice.once(4);
  c.options.triangles = dice.once(8) ? 1 + dice.below(500) : 0;
  if (dice.once(4)) addTexture(dice, c, most_samples);
  switch (dice.below(8)) {
    case 0:
    case 1:
      putOnCylinder(dice, c);
      break;
    case 2:
    case 3:
      putOnForest(dice, c, kind, most_samples);
      break;
    case 4:
      putOnCube(dice, c, kind, most_samples);
      break;
    default:
      break;
  }
  c.description =
      std::string(kKindNames[static_cast<size_t>(kind)]) + ", " + target + ", " + described(c);
  return c;
}

}  // namespace tetrakis::test
