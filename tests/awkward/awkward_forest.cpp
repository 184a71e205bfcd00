// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/awkward_forest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "base/samples.hpp"
#include "tests/awkward/shared_samples.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {

namespace {

/// Any two sides are glued, those of one patch and of one corner as well, until so many are left.
std::vector<uint32_t> gluedAnyhow(Dice& dice, uint32_t patches, uint32_t borders) {
  std::vector<uint32_t> sides(4 * size_t{patches}, TKS_BORDER), loose(sides.size());
  std::iota(loose.begin(), loose.end(), 0u);
  const auto take = [&] {
    std::swap(loose[dice.below(static_cast<uint32_t>(loose.size()))], loose.back());
    const uint32_t side = loose.back();
    loose.pop_back();
    return side;
  };
  while (loose.size() > borders + 1) {
    const uint32_t a = take(), b = take();
    sides[a] = b;
    sides[b] = a;
  }
  return sides;
}

/// So many patches have their north-west corners at one place.
std::vector<uint32_t> star(uint32_t patches) {
  std::vector<uint32_t> sides(4 * size_t{patches}, TKS_BORDER);
  for (uint32_t patch = 0; patch < patches; ++patch) {
    const uint32_t north = 4 * patch, west = 4 * ((patch + 1) % patches) + 3;
    sides[north] = west;
    sides[west] = north;
  }
  return sides;
}

std::vector<uint32_t> awkwardSides(Dice& dice) {
  const uint32_t patches = 1 + dice.below(dice.once(4) ? 40 : 7);
  switch (dice.below(4)) {
    case 0: {
      const std::vector<ForestShape> shapes = forestShapes();
      return shapes[dice.below(static_cast<uint32_t>(shapes.size()))].sides;
    }
    case 1:
      return star(patches);
    case 2:
      return gluedAnyhow(dice, patches, 0);
    default:
      return gluedAnyhow(dice, patches, dice.below(4 * patches));
  }
}

uint32_t awkwardDepth(Dice& dice, uint32_t patches, uint32_t most_samples) {
  uint32_t depth = 1 + dice.below(5);
  while (depth > 1 && (patches << 2 * depth) > most_samples) --depth;
  return depth;
}

/// What forests refuse.
void leaveOut(Dice& dice, AwkwardCase& c) {
  c.nodata.reset();
  if (c.heights.sample != TKS_F32 && dice.once(4)) c.nodata = -9999.5;  // that no sample has
  c.options.triangles = 0;
}

void putTextureOnPatches(Dice& dice, AwkwardCase& c, uint32_t most_samples) {
  if (!c.texture) return;
  const auto patches = static_cast<uint32_t>(c.sides.size() / 4);
  c.texture_depth = awkwardDepth(dice, patches, most_samples);
  samples::Recipe recipe;
  recipe.pattern = static_cast<samples::Pattern>(dice.below(6));
  recipe.width = (1u << c.texture_depth) + 1;
  recipe.height = recipe.width * patches;
  recipe.channels = c.texture->channels;
  recipe.sample = c.texture->sample;
  recipe.seed = static_cast<uint32_t>(dice.next());
  c.texture = samples::make(recipe);
  SharedSamples(c.texture_depth, c.sides)
      .share(c.texture->data, recipe.channels * tks_sample_bytes(recipe.sample));
}

double sampleAt(const samples::Raster& raster, size_t i) {
  return withSampleType(raster.sample, [&](auto sample) {
    std::memcpy(&sample, raster.data.data() + i * sizeof sample, sizeof sample);
    return static_cast<double>(sample);
  });
}

/// Rows that reach the poles, as areas or as points, or end before them. Either may come first.
tks_geographic_grid roundEarth(Dice& dice, uint32_t width, uint32_t height) {
  tks_geographic_grid grid = {sizeof grid, width, height, {}};
  const uint32_t rows = dice.below(3);
  const double row = rows == 0 ? 180.0 / height : rows == 1 ? 180.0 / (height - 1) : 150.0 / height;
  const double north = rows == 0 ? 90 : rows == 1 ? 90 + row / 2 : 80;
  const bool turned = dice.once(4), westwards = dice.once(4);
  const double column = 360.0 / width;
  constexpr std::array<double, 5> kWest = {-180, 0, -180.25, 33.3, 179};
  const double west = dice.of(kWest);
  grid.geotransform[0] = westwards ? west + 360 : west;
  grid.geotransform[1] = westwards ? -column : column;
  grid.geotransform[3] = turned ? north - row * height : north;
  grid.geotransform[5] = turned ? row : -row;
  return grid;
}

/// Finite heights that resampling takes.
std::vector<float> tameHeights(const samples::Raster& raster) {
  std::vector<float> heights(size_t{raster.width} * raster.height);
  for (size_t i = 0; i < heights.size(); ++i)
    heights[i] = static_cast<float>(std::clamp(sampleAt(raster, i), -1e29, 1e29));
  return heights;
}

/// As the command line does it: the nearest samples of the type.
void storeRounded(samples::Raster& raster, std::span<const float> heights) {
  const Bounds bounds = boundsOf(raster.sample);
  raster.data.resize(heights.size() * tks_sample_bytes(raster.sample));
  for (size_t i = 0; i < heights.size(); ++i) {
    const double height = heights[i];
    storeSample(raster, i,
                raster.sample == TKS_F32
                    ? height
                    : std::clamp(std::nearbyint(height), bounds.low, bounds.high));
  }
}

}  // namespace

void putOnForest(Dice& dice, AwkwardCase& c, Kind kind, uint32_t most_samples) {
  c.domain = TKS_DOMAIN_FOREST;
  c.sides = awkwardSides(dice);
  const auto patches = static_cast<uint32_t>(c.sides.size() / 4);
  c.depth = awkwardDepth(dice, patches, most_samples);
  const uint32_t side = (1u << c.depth) + 1;
  c.heights = groundOf(dice, kind, side, side * patches);
  SharedSamples(c.depth, c.sides).share(c.heights.data, tks_sample_bytes(c.heights.sample));
  leaveOut(dice, c);
  putTextureOnPatches(dice, c, most_samples);
}

void putOnCube(Dice& dice, AwkwardCase& c, Kind kind, uint32_t most_samples) {
  c.domain = TKS_DOMAIN_FOREST;
  c.sides.assign(tks_cube_sides(), tks_cube_sides() + 24);
  c.depth = awkwardDepth(dice, 6, most_samples);
  const uint32_t width = 1 + dice.below(90), height = 2 + dice.below(50);
  const samples::Raster ground = groundOf(dice, kind, width, height);
  c.grid = roundEarth(dice, width, height);
  c.heights.sample = ground.sample;
  c.heights.width = (1u << c.depth) + 1;
  c.heights.height = 6 * c.heights.width;
  std::vector<float> cube(size_t{c.heights.width} * c.heights.height);
  std::array<char, 256> message{};
  if (tks_cube_from_grid(&*c.grid, tameHeights(ground).data(), c.depth, 1, cube.data(), nullptr,
                         nullptr, message.data(), message.size()) != TKS_OK) {
    std::fprintf(stderr, "no cube of a grid of %u x %u: %s\n", width, height, message.data());
    std::abort();
  }
  storeRounded(c.heights, cube);
  leaveOut(dice, c);
  putTextureOnPatches(dice, c, most_samples);
}

void putOnCylinder(Dice& dice, AwkwardCase& c) {
  c.domain = TKS_DOMAIN_CYLINDER;
  if (c.heights.width < 2 || c.heights.height < 2 || dice.once(2)) return;
  c.grid = roundEarth(dice, c.heights.width, c.heights.height);
}

}  // namespace tetrakis::test
