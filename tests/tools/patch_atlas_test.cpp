// SPDX-License-Identifier: Apache-2.0
// Atlases of the texels of forests.
#include "apps/tools/report/patch_atlas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace tetrakis::tools {
namespace {

ImageFile rasterOf(std::mt19937& random, uint32_t patches, uint32_t depth) {
  const uint32_t side = (1u << depth) + 1;
  ImageFile raster{side, side * patches, 3, TKS_U8, {}};
  for (size_t i = 0; i < size_t{3} * side * side * patches; ++i)
    raster.data.push_back(static_cast<std::byte>(random() % 256));
  return raster;
}

/// Where the texel of a place begins in the picture's data.
size_t texelAt(const ImageFile& picture, std::array<double, 2> place) {
  const auto x = static_cast<size_t>(std::floor(place[0] * picture.width));
  const auto y = static_cast<size_t>(std::floor(place[1] * picture.height));
  return 3 * (y * picture.width + x);
}

TEST(PatchAtlas, ShowsEachTexelAtItsPlace) {
  std::mt19937 random(1);
  for (const uint32_t patches : {1u, 2u, 5u, 17u}) {
    for (const uint32_t depth : {1u, 3u}) {
      const ImageFile raster = rasterOf(random, patches, depth);
      const PatchAtlas atlas(patches, depth);
      const ImageFile picture = atlas.pictureOf(raster);
      ASSERT_EQ(picture.data.size(), size_t{3} * picture.width * picture.height);
      const uint32_t side = raster.width, steps = 1u << depth;
      for (uint32_t patch = 0; patch < patches; ++patch) {
        for (uint32_t texel = 0; texel < side * side; ++texel) {
          const uint32_t x = texel % side, y = texel / side;
          const auto place = atlas.at(patch, double(x) / steps, double(y) / steps);
          // In its middle, where no other texel has a part.
          EXPECT_NEAR(place[0] * picture.width - std::floor(place[0] * picture.width), 0.5, 1e-6);
          EXPECT_NEAR(place[1] * picture.height - std::floor(place[1] * picture.height), 0.5, 1e-6);
          const size_t from = 3 * (size_t{patch} * side * side + texel);
          for (size_t c = 0; c < 3; ++c)
            ASSERT_EQ(picture.data[texelAt(picture, place) + c], raster.data[from + c]);
        }
      }
    }
  }
}

TEST(PatchAtlas, RepeatsBordersAroundPatches) {
  std::mt19937 random(2);
  const uint32_t patches = 7, depth = 2, steps = 1u << depth;
  const PatchAtlas atlas(patches, depth);
  const ImageFile picture = atlas.pictureOf(rasterOf(random, patches, depth));
  for (uint32_t patch = 0; patch < patches; ++patch) {
    for (uint32_t k = 0; k <= steps; ++k) {
      const double along = double(k) / steps, beyond = 1. / steps;
      const auto same = [&](double x, double y, double from_x, double from_y) {
        const size_t gutter = texelAt(picture, atlas.at(patch, x, y));
        const size_t border = texelAt(picture, atlas.at(patch, from_x, from_y));
        for (size_t c = 0; c < 3; ++c)
          EXPECT_EQ(picture.data[gutter + c], picture.data[border + c]) << patch << " " << k;
      };
      same(along, -beyond, along, 0);
      same(along, 1 + beyond, along, 1);
      same(-beyond, along, 0, along);
      same(1 + beyond, along, 1, along);
    }
  }
}

}  // namespace
}  // namespace tetrakis::tools
