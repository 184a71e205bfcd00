// SPDX-License-Identifier: Apache-2.0
// Heights for game engines: sizes, ranges, voids.
#include "apps/tools/files/engine_heights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;

EngineHeights heightsOf(const std::vector<float>& heights, uint32_t width, EngineSize size) {
  const auto rows = static_cast<uint32_t>(heights.size() / width);
  const auto out = engineHeights({heights, width, rows, 10, 20, 0.5}, size);
  EXPECT_TRUE(out.ok());
  return *out;
}

TEST(EngineHeights, SizesAreThoseOfTheEngine) {
  EXPECT_EQ(parseEngineSize("unreal", 513)->side, 1009U);
  EXPECT_EQ(parseEngineSize("unreal", 1009)->side, 1009U);
  EXPECT_EQ(parseEngineSize("unreal", 100000)->side, 8129U);
  EXPECT_EQ(parseEngineSize("unity", 2)->side, 33U);
  EXPECT_EQ(parseEngineSize("unity", 514)->side, 1025U);
  EXPECT_EQ(parseEngineSize("unreal:4033", 2)->side, 4033U);
  for (const char* wrong : {"", "godot", "unity:512", "unity:", "unreal:1009x", "unreal:-1"})
    EXPECT_EQ(parseEngineSize(wrong, 513).status().code(), TKS_USAGE) << wrong;
}

TEST(EngineHeights, FormatsAreThoseThatTheEngineImports) {
  const EngineSize unreal{Engine::kUnreal, 127}, unity{Engine::kUnity, 33};
  for (const char* name : {"a.r16", "a.raw"}) {
    EXPECT_TRUE(checkEngineFormat(unreal, name).ok());
    EXPECT_TRUE(checkEngineFormat(unity, name).ok());
  }
  EXPECT_TRUE(checkEngineFormat(unreal, "a.png").ok());
  EXPECT_EQ(checkEngineFormat(unity, "a.png").code(), TKS_USAGE);
  EXPECT_EQ(checkEngineFormat(unreal, "a.tif").code(), TKS_USAGE);
}

TEST(EngineHeights, EqualSizesKeepTheSamples) {
  std::vector<float> ground;
  for (int i = 0; i < 33 * 33; ++i) ground.push_back(static_cast<float>((i * 37) % 1089));
  const EngineHeights out = heightsOf(ground, 33, {Engine::kUnity, 33});
  EXPECT_EQ(out.lowest, 0);
  EXPECT_EQ(out.highest, 544);
  EXPECT_EQ(out.width, 320);
  EXPECT_EQ(out.length, 640);
  for (size_t i = 0; i < ground.size(); ++i)
    EXPECT_EQ(out.samples[i], std::lround(ground[i] / 1088 * 65535)) << i;
}

TEST(EngineHeights, PlanesStayPlanesInTheirRange) {
  for (const uint32_t width : {2U, 3U, 50U}) {
    std::vector<float> ground;
    for (uint32_t i = 0; i < width * 7; ++i) ground.push_back(static_cast<float>(i % width));
    const EngineHeights out = heightsOf(ground, width, {Engine::kUnity, 65});
    for (uint32_t row = 0; row < 65; ++row) {
      EXPECT_EQ(out.samples[row * 65], 0);
      EXPECT_EQ(out.samples[row * 65 + 64], 65535);
      EXPECT_NEAR(out.samples[row * 65 + 32], 32768, 65535 * 0.08);
    }
  }
}

/// A coarse level ends before the ground does: what is there lies where it lay, and the rest is
/// level.
TEST(EngineHeights, ACoarseLevelCoversTheGround) {
  std::vector<float> ground;
  for (int i = 0; i < 5 * 5; ++i) ground.push_back(static_cast<float>(i % 5));
  const auto out = engineHeights({ground, 5, 5, 8, 8, 1, {}, 0.8, 0.8}, {Engine::kUnity, 33});
  ASSERT_TRUE(out.ok());
  EXPECT_DOUBLE_EQ(out->width, 4.8 * 8);
  EXPECT_DOUBLE_EQ(out->length, 4.8 * 8);
  for (int i = 7; i <= 20; ++i)  // the cubic needs a sample on either side
    EXPECT_NEAR(out->samples[i], 65535 * i * 4.8 / 32 / 4, 1) << i;
  for (int i = 27; i < 33; ++i) EXPECT_EQ(out->samples[i], 65535) << i;
}

TEST(EngineHeights, VoidsLieAtTheBottomAndFlatGroundIsZero) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const EngineHeights out = heightsOf({5, 9, none, 9}, 2, {Engine::kUnity, 33});
  EXPECT_EQ(out.voids, 1U);
  EXPECT_EQ(out.samples[32 * 33], 0);
  for (const uint16_t sample : heightsOf({7, 7, 7, 7}, 2, {Engine::kUnity, 33}).samples)
    EXPECT_EQ(sample, 0);
  const std::vector<float> empty(4, none);
  EXPECT_EQ(engineHeights({empty, 2, 2, 1, 1, 1}, {Engine::kUnity, 33}).status().code(), TKS_USAGE);
}

TEST(EngineHeights, TheFirstSampleIsTheNorthWesternOne) {
  const std::vector<float> north_up{0, 1, 2, 3, 4, 9};  // two rows of three
  const EngineHeights wanted = heightsOf(north_up, 3, {Engine::kUnity, 33});
  EXPECT_FALSE(wanted.askew);
  struct Case {
    std::vector<float> heights;
    uint32_t width;
    GroundAxes axes;
  };
  const std::vector<Case> cases{
      {{3, 4, 9, 0, 1, 2}, 3, {{1, 0}, {0, -1}}},
      {{2, 1, 0, 9, 4, 3}, 3, {{-1, 0}, {0, 1}}},
      {{9, 4, 3, 2, 1, 0}, 3, {{-1, 0}, {0, -1}}},
      {{0, 3, 1, 4, 2, 9}, 2, {{0, 1}, {1, 0}}},
      {{3, 0, 4, 1, 9, 2}, 2, {{0, -1}, {1, 0}}},
      {{2, 9, 1, 4, 0, 3}, 2, {{0, 1}, {-1, 0}}},
      {{9, 2, 4, 1, 3, 0}, 2, {{0, -1}, {-1, 0}}},
      {{3, 4, 9, 0, 1, 2}, 3, {{0.8, 0.6}, {0.6, -0.8}}},
  };
  for (const auto& [heights, width, axes] : cases) {
    const bool transposed = width == 2;
    const auto out = engineHeights(
        {heights, width, 6 / width, transposed ? 20.0 : 10.0, transposed ? 10.0 : 20.0, 0.5, axes},
        {Engine::kUnity, 33});
    ASSERT_TRUE(out.ok());
    EXPECT_EQ(out->samples, wanted.samples);
    EXPECT_EQ(out->width, wanted.width);
    EXPECT_EQ(out->length, wanted.length);
    EXPECT_EQ(out->askew, axes.along[0] == 0.8);
  }
}

class EngineFiles : public ScratchFolder {};

TEST_F(EngineFiles, EngineFilesAreLittleEndianOrPng) {
  const EngineHeights out = heightsOf({0, 1, 2, 4}, 2, {Engine::kUnreal, 127});
  ASSERT_TRUE(writeEngineHeights(path("a.raw"), out).ok());
  ASSERT_TRUE(writeEngineHeights(path("a.png"), out).ok());
  const auto plain = readHeights(path("a.raw") + ":127x127:u16");
  const auto png = readHeights(path("a.png"));
  ASSERT_TRUE(plain.ok() && png.ok());
  EXPECT_EQ(plain->data, png->data);
  EXPECT_EQ(writeEngineHeights(path("missing/a.r16"), out).code(), TKS_IO);
}

}  // namespace
}  // namespace tetrakis::tools
