// SPDX-License-Identifier: Apache-2.0
// Pictures, and what errors on the ground do to them.
#include "apps/tools/render/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "apps/tools/render/texture_pyramid.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::tools {
namespace {

using Rgb = std::array<int, 3>;

ImageFile imageOf(uint32_t width, uint32_t height, uint32_t channels,
                  const std::vector<int>& samples) {
  ImageFile image{width, height, channels, TKS_U8, {}};
  for (const int sample : samples) image.data.push_back(static_cast<std::byte>(sample));
  return image;
}

/// Repeats each texel of a 2 x 2 picture so that filtering leaves block centres alone.
ImageFile blocks(const std::array<std::vector<int>, 4>& texels, uint32_t side) {
  std::vector<int> samples;
  for (uint32_t y = 0; y < 2 * side; ++y) {
    for (uint32_t x = 0; x < 2 * side; ++x) {
      const std::vector<int>& texel = texels[2 * (y / side) + x / side];
      samples.insert(samples.end(), texel.begin(), texel.end());
    }
  }
  return imageOf(2 * side, 2 * side, static_cast<uint32_t>(texels[0].size()), samples);
}

/// A square from (-1, -1) to (1, 1) with the height of each corner: north-west, north-east,
/// south-west, south-east.
MeshFile square(const std::array<float, 4>& heights) {
  MeshFile mesh;
  mesh.positions = {-1, heights[0], -1, 1, heights[1], -1, -1, heights[2], 1, 1, heights[3], 1};
  mesh.texcoords = {0, 0, 1, 0, 0, 1, 1, 1};
  mesh.triangles = {0, 2, 1, 1, 2, 3};
  return mesh;
}

/// Sees (-1, -1) to (1, 1) at height 0 fill a square picture from straight above.
Camera above(uint32_t pixels) {
  Camera camera;
  camera.eye = {0, 10, 0};
  camera.up = {0, 0, -1};
  camera.fov_y = 2 * std::atan(0.1) * 180 / std::numbers::pi;
  camera.width = camera.height = pixels;
  return camera;
}

Rgb pixel(const Picture& picture, uint32_t x, uint32_t y) {
  const uint8_t* p = &picture.rgba[4 * (size_t{y} * picture.width + x)];
  return {p[0], p[1], p[2]};
}

int alpha(const Picture& picture, uint32_t x, uint32_t y) {
  return picture.rgba[4 * (size_t{y} * picture.width + x) + 3];
}

class Rendering : public testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<Renderer>> created = Renderer::create();
    ASSERT_TRUE(created.ok()) << created.status().message();
    renderer_ = std::move(*created);
  }

  Picture draw(const MeshFile& mesh, const Camera& camera) {
    Result<Picture> picture = renderer_->draw(mesh, camera);
    EXPECT_TRUE(picture.ok()) << picture.status().message();
    return picture.ok() ? std::move(*picture) : Picture{};
  }

  tks_status failure(const MeshFile& mesh, const Camera& camera) {
    const Result<Picture> picture = renderer_->draw(mesh, camera);
    EXPECT_FALSE(picture.ok());
    return picture.status().code();
  }

  std::unique_ptr<Renderer> renderer_;
};

TEST_F(Rendering, LaysTheTextureNorthUp) {
  const ImageFile image = blocks({{{200, 10, 20}, {30, 210, 40}, {50, 60, 220}, {90, 80, 70}}}, 8);
  MeshFile mesh = square({0, 0, 0, 0});
  mesh.texture = &image;
  const Picture picture = draw(mesh, above(64));
  EXPECT_EQ(pixel(picture, 16, 16), (Rgb{200, 10, 20}));
  EXPECT_EQ(pixel(picture, 48, 16), (Rgb{30, 210, 40}));
  EXPECT_EQ(pixel(picture, 16, 48), (Rgb{50, 60, 220}));
  EXPECT_EQ(pixel(picture, 48, 48), (Rgb{90, 80, 70}));
  EXPECT_EQ(alpha(picture, 0, 0), 255);
  EXPECT_EQ(alpha(picture, 63, 63), 255);
}

TEST_F(Rendering, ReducesGreyAlphaAndSixteenBits) {
  const ImageFile grey = blocks({{{10}, {80}, {160}, {250}}}, 8);
  const ImageFile rgb = blocks({{{10, 10, 10}, {80, 80, 80}, {160, 160, 160}, {250, 250, 250}}}, 8);
  ImageFile deep = grey;
  deep.sample = TKS_U16;
  deep.data.resize(2 * grey.data.size());
  for (size_t i = 0; i < grey.data.size(); ++i) {
    const auto value = static_cast<uint16_t>(257 * std::to_integer<int>(grey.data[i]));
    std::memcpy(&deep.data[2 * i], &value, 2);
  }
  MeshFile mesh = square({0, 0, 0, 0});
  mesh.texture = &rgb;
  const Picture expected = draw(mesh, above(50));
  for (const ImageFile* image : {&grey, &std::as_const(deep)}) {
    mesh.texture = image;
    EXPECT_EQ(draw(mesh, above(50)).rgba, expected.rgba);
  }
}

TEST_F(Rendering, TransparentTexelsAreHoles) {
  const ImageFile image = blocks({{{200, 255}, {200, 0}, {200, 0}, {90, 255}}}, 8);
  MeshFile mesh = square({0, 0, 0, 0});
  mesh.texture = &image;
  const Picture picture = draw(mesh, above(64));
  EXPECT_EQ(alpha(picture, 16, 16), 255);
  EXPECT_EQ(alpha(picture, 48, 16), 0);
  EXPECT_EQ(alpha(picture, 16, 48), 0);
  EXPECT_EQ(pixel(picture, 48, 48), (Rgb{90, 90, 90}));
}

TEST_F(Rendering, NothingInSightIsSky) {
  Camera camera = above(40);
  camera.target = {0, 20, 0};
  const Picture picture = draw(square({0, 0, 0, 0}), camera);
  for (uint32_t i = 0; i < 40; ++i) EXPECT_EQ(alpha(picture, i, i), 0);
  EXPECT_GT(pixel(picture, 20, 0)[2], pixel(picture, 20, 0)[0]);  // blue
  EXPECT_EQ(draw(MeshFile{}, camera).rgba, picture.rgba);
}

TEST_F(Rendering, AveragesFourSamplesAtEdges) {
  Camera camera = above(100);
  camera.eye[0] = camera.target[0] =
      0.005;  // a quarter of a pixel to the right: one sample off the edge
  const Picture picture = draw(square({0, 0, 0, 0}), camera);
  EXPECT_EQ(alpha(picture, 50, 50), 255);
  EXPECT_EQ(alpha(picture, 99, 50), 128);
}

TEST_F(Rendering, NearGroundHidesFarGround) {
  const ImageFile image = blocks({{{200, 0, 0}, {0, 200, 0}, {0, 0, 200}, {90, 90, 90}}}, 8);
  for (const bool near_first : {false, true}) {
    MeshFile mesh = square({0, 0, 0, 0});
    mesh.texture = &image;
    const float lift = near_first ? -0.5f : 0.5f;
    for (size_t i = 0; i < 12; ++i)
      mesh.positions.push_back(mesh.positions[i] + (i % 3 == 1 ? lift : 0));
    mesh.texcoords.insert(mesh.texcoords.end(), 8, 0.0f);  // red all over
    for (size_t i = 0; i < 6; ++i) mesh.triangles.push_back(mesh.triangles[i] + 4);
    const Rgb expected = near_first ? Rgb{90, 90, 90} : Rgb{200, 0, 0};
    EXPECT_EQ(pixel(draw(mesh, above(64)), 47, 47), expected);
  }
}

TEST_F(Rendering, ShadesHillsFromTheNorthWest) {
  const auto brightness = [&](const std::array<float, 4>& heights) {
    return pixel(draw(square(heights), above(20)), 10, 10)[0];
  };
  const int level = brightness({0, 0, 0, 0});
  EXPECT_GT(brightness({-0.2f, 0, 0, 0.2f}), level);
  EXPECT_LT(brightness({0.2f, 0, 0, -0.2f}), level);
}

TEST_F(Rendering, LeavesOutTrianglesThatAreNotFinite) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    MeshFile mesh = square({0, 0, 0, bad});
    const Picture picture = draw(mesh, above(40));
    EXPECT_EQ(alpha(picture, 10, 10), 255);
    EXPECT_EQ(alpha(picture, 30, 30), 0);
  }
}

TEST_F(Rendering, SeveralCamerasGiveWhatSingleOnesGive) {
  const MeshFile mesh = square({0, 0.5f, 0.25f, 0});
  const Result<std::vector<Camera>> cameras = presetCameras("all", {{-1, 0, -1}, {1, 0.5, 1}});
  ASSERT_TRUE(cameras.ok());
  const Result<std::vector<Picture>> pictures = renderer_->draw(mesh, *cameras);
  ASSERT_TRUE(pictures.ok());
  ASSERT_EQ(pictures->size(), cameras->size());
  for (size_t i = 0; i < cameras->size(); ++i)
    EXPECT_EQ((*pictures)[i].rgba, draw(mesh, (*cameras)[i]).rgba);
}

/// Pictures of two programs need not agree to the bit: a driver of a graphics card rounds the
/// coordinates of a fragment as suits the program.
void expectAlike(const Picture& a, const Picture& b) {
  ASSERT_EQ(a.rgba.size(), b.rgba.size());
  int most = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i)
    most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  EXPECT_LE(most, 2);
}

/// Several textures are drawn at once, unless one of them has holes.
TEST_F(Rendering, EachTextureGivesWhatItGivesAlone) {
  const Result<std::vector<Camera>> cameras = presetCameras("all", {{-1, 0, -1}, {1, 0.5, 1}});
  ASSERT_TRUE(cameras.ok());
  std::vector<ImageFile> images;
  for (uint8_t i = 0; i < 9; ++i) {
    const auto colour = static_cast<uint8_t>(25 * i);
    images.push_back(
        blocks({{{colour, 10, 20}, {30, colour, 40}, {50, 60, colour}, {9, 8, 7}}}, 8));
  }
  ImageFile with_holes = blocks({{{200, 255}, {30, 0}, {50, 255}, {90, 0}}}, 8);
  MeshFile mesh = square({0, 0.5f, 0.25f, 0});
  for (const size_t count : {0u, 1u, 2u, 3u, 4u, 5u, 9u, 10u}) {
    if (count == 10) images.push_back(with_holes);
    mesh.texture = nullptr;
    ASSERT_TRUE(renderer_->takeTextures(std::span(images).first(count)).ok());
    std::vector<std::vector<Picture>> drawn;
    const auto take = [&](std::vector<Picture> pictures) { drawn.push_back(std::move(pictures)); };
    ASSERT_TRUE(renderer_->drawWithEach(mesh, *cameras, take).ok());
    ASSERT_EQ(drawn.size(), count);
    for (size_t i = 0; i < count; ++i) {
      mesh.texture = &images[i];
      ASSERT_EQ(drawn[i].size(), cameras->size());
      for (size_t c = 0; c < cameras->size(); ++c) {
        SCOPED_TRACE(std::to_string(i) + " of " + std::to_string(count));
        expectAlike(drawn[i][c], draw(mesh, (*cameras)[c]));
      }
    }
  }
}

TEST_F(Rendering, RenderersDoNotDisturbEachOther) {
  const MeshFile mesh = square({0, 0.5f, 0.25f, 0});
  const Picture first = draw(mesh, above(30));
  {
    Result<std::unique_ptr<Renderer>> other = Renderer::create();
    ASSERT_TRUE(other.ok());
    const Result<Picture> second = (*other)->draw(mesh, above(30));
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(second->rgba, first.rgba);
    EXPECT_EQ(draw(mesh, above(30)).rgba, first.rgba);
  }
  EXPECT_EQ(draw(mesh, above(30)).rgba, first.rgba);
}

TEST_F(Rendering, RefusesWhatDoesNotFit) {
  MeshFile mesh = square({0, 0, 0, 0});
  EXPECT_EQ(failure(mesh, above(0)), TKS_LIMIT);
  EXPECT_EQ(failure(mesh, above(1u << 20)), TKS_LIMIT);
  mesh.triangles.back() = 4;
  EXPECT_EQ(failure(mesh, above(8)), TKS_USAGE);
  mesh = square({0, 0, 0, 0});
  ImageFile image = imageOf(1, 1, 3, {1, 2, 3});
  mesh.texture = &image;
  mesh.texcoords.clear();
  EXPECT_EQ(failure(mesh, above(8)), TKS_USAGE);
  mesh = square({0, 0, 0, 0});
  mesh.texture = &image;
  image.data.pop_back();
  EXPECT_EQ(failure(mesh, above(8)), TKS_USAGE);
}

TEST_F(Rendering, ShrinksTexturesBeyondTheDriver) {
  constexpr uint32_t kWidth = 70000;  // more than any driver takes
  ImageFile image{kWidth, 1, 3, TKS_U8, std::vector<std::byte>(size_t{3} * kWidth)};
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<std::byte>(i < image.data.size() / 2 ? 40 : 160);
  MeshFile mesh = square({0, 0, 0, 0});
  mesh.texture = &image;
  const Picture picture = draw(mesh, above(32));
  EXPECT_EQ(pixel(picture, 8, 16), (Rgb{40, 40, 40}));
  EXPECT_EQ(pixel(picture, 24, 16), (Rgb{160, 160, 160}));
}

TEST(TexturePyramid, HalvesByArea) {
  const auto levels = texturePyramid(imageOf(5, 1, 1, {10, 20, 30, 40, 50}), 5);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1].width, 2u);
  EXPECT_EQ(levels[2].width, 1u);
  EXPECT_EQ(levels[1].rgba[0], 18);  // (2 * 10 + 2 * 20 + 30) / 5
  EXPECT_EQ(levels[1].rgba[4], 42);  // (30 + 2 * 40 + 2 * 50) / 5
  EXPECT_EQ(levels[2].rgba[0], 30);
  EXPECT_EQ(levels[2].rgba[3], 255);
}

TEST(TexturePyramid, KeepsAConstantAndFitsTheLimit) {
  for (const uint32_t width : {1u, 2u, 3u, 7u, 12u, 31u}) {
    for (const uint32_t height : {1u, 5u, 16u}) {
      const std::vector<int> samples(size_t{2} * width * height, 200);
      const auto levels = texturePyramid(imageOf(width, height, 2, samples), 9);
      EXPECT_LE(std::max(levels[0].width, levels[0].height), 9u);
      EXPECT_EQ(levels.back().width * levels.back().height, 1u);
      for (const TextureLevel& level : levels) {
        ASSERT_EQ(level.rgba.size(), size_t{4} * level.width * level.height);
        for (size_t i = 0; i < level.rgba.size(); ++i)
          EXPECT_EQ(level.rgba[i], i % 4 == 3 ? 200 : 157);  // 200 * 200 / 255
      }
    }
  }
}

Picture pictureOf(std::vector<uint8_t> rgba) {
  return {static_cast<uint32_t>(rgba.size() / 4), 1, std::move(rgba)};
}

TEST(ScreenPsnr, CountsPixelsThatEitherCovers) {
  const Picture a = pictureOf({10, 20, 30, 255, 90, 90, 90, 0, 7, 7, 7, 0});
  const Picture b = pictureOf({13, 20, 26, 255, 90, 90, 96, 64, 99, 99, 99, 0});
  // Covered: the first two; squared errors 9 + 16 and 36 over six values.
  const double expected = 10 * std::log10(255.0 * 255.0 / (61.0 / 6));
  EXPECT_NEAR(screenPsnr({a}, {b}), expected, 1e-12);
  EXPECT_NEAR(screenPsnr({b}, {a}), expected, 1e-12);
}

TEST(ScreenPsnr, AveragesTheErrorOverPicturesThatShowAnything) {
  const Picture a = pictureOf({0, 0, 0, 255}), b = pictureOf({6, 0, 0, 255});
  const Picture empty = pictureOf({1, 2, 3, 0});
  const double expected = 10 * std::log10(255.0 * 255.0 / 6);  // mean of 12 and 0
  EXPECT_NEAR(screenPsnr({a, a, empty}, {b, a, empty}), expected, 1e-12);
  EXPECT_EQ(screenPsnr({a, empty}, {a, empty}), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(screenPsnr({a}, {a, b})));
  const double weighted = 10 * std::log10(255.0 * 255.0 / 3);  // a quarter of 12
  EXPECT_NEAR(screenPsnr({a, a, empty}, {b, a, empty}, {0.5, 1.5, 9}), weighted, 1e-12);
  EXPECT_TRUE(std::isnan(screenPsnr({a, a}, {b, a}, {1})));
  EXPECT_TRUE(std::isnan(screenPsnr({a}, {pictureOf({0, 0, 0, 255, 0, 0, 0, 255})})));
}

}  // namespace
}  // namespace tetrakis::tools
