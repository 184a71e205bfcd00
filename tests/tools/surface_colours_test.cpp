// SPDX-License-Identifier: Apache-2.0
// What the surface of a mesh shows of its image.
#include <gtest/gtest.h>

#include <cstring>

#include "apps/tools/files/meshes/surface_file.hpp"

namespace tetrakis::tools {
namespace {

SurfaceFile painted(uint32_t channels) {
  SurfaceFile surface;
  surface.texture = ImageFile{16, 16, channels, TKS_U8, {}};
  for (size_t i = 0; i < size_t{256} * channels; ++i)
    surface.texture->data.push_back(static_cast<std::byte>(i / channels));
  return surface;
}

TEST(SurfaceColours, AlphaGoesAndColoursStay) {
  for (const uint32_t channels : {2u, 4u}) {
    const ImageFile image = withoutAlpha(*painted(channels).texture);
    EXPECT_EQ(image.channels, channels - 1);
    EXPECT_EQ(image.data, painted(channels - 1).texture->data);
  }
  ImageFile deep{1, 2, 2, TKS_U16, {}};
  const uint16_t values[] = {1000, 65535, 2000, 0};
  deep.data.resize(sizeof values);
  std::memcpy(deep.data.data(), values, sizeof values);
  const ImageFile grey = withoutAlpha(deep);
  ASSERT_EQ(grey.data.size(), 2 * sizeof(uint16_t));
  EXPECT_EQ(std::memcmp(grey.data.data(), &values[0], 2), 0);
  EXPECT_EQ(std::memcmp(grey.data.data() + 2, &values[2], 2), 0);
}

TEST(SurfaceColours, FactorsOfGltfAreOfLight) {
  SurfaceFile surface = painted(3);
  surface.y_is_up = true;
  surface.base_colour = {0.5, 1, 0.25, 1};
  const ImageFile shown = shownTexture(surface);
  EXPECT_EQ(static_cast<int>(shown.data[3 * 255]), 188);  // sRGB of half the light
  EXPECT_EQ(static_cast<int>(shown.data[3 * 255 + 1]), 255);
  EXPECT_EQ(static_cast<int>(shown.data[3 * 255 + 2]), 137);
  EXPECT_EQ(static_cast<int>(shown.data[0]), 0);
  surface.y_is_up = false;
  EXPECT_EQ(static_cast<int>(shownTexture(surface).data[3 * 200]), 100);
}

TEST(SurfaceColours, WhiteAndBlackLeaveTheTexture) {
  SurfaceFile surface = painted(3);
  for (const double factor : {0.0, 1.0}) {
    surface.base_colour = {factor, factor, factor, 1};
    EXPECT_EQ(shownTexture(surface).data, surface.texture->data);
  }
}

}  // namespace
}  // namespace tetrakis::tools
