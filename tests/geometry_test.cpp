// SPDX-License-Identifier: Apache-2.0
// Levels of the lattice, lifting, and geometry tracks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "codec/geometry_decoder.hpp"
#include "codec/geometry_encoder.hpp"
#include "codec/levels.hpp"
#include "codec/lifting.hpp"

namespace tetrakis {
namespace {

struct Size {
  uint32_t width, height;
};

const std::vector<Size> kSizes = {{2, 2},    {2, 3},     {3, 2},   {2, 9},   {3, 17},
                                  {5, 5},    {8, 8},     {17, 31}, {33, 65}, {1, 1},
                                  {3, 1000}, {300, 200}, {127, 64}};

std::vector<int32_t> randomHeights(const Size& size, int32_t bound, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<int32_t> heights(size_t{size.width} * size.height);
  for (int32_t& h : heights) {
    h = static_cast<int32_t>(random() % (2 * static_cast<uint32_t>(bound))) - bound;
  }
  return heights;
}

TEST(Levels, EveryVertexBelongsToExactlyOneLevel) {
  for (const Size& size : kSizes) {
    if (size.width < 2) continue;
    std::vector<int> owners(size_t{size.width} * size.height, 0);
    for (const Level& level : levelsOf(size.width, size.height)) {
      for (uint32_t row = 0; row < level.shape.rows; ++row) {
        for (uint32_t column = 0; column < level.shape.columns[row % 2]; ++column) {
          const uint32_t x = level.firstX(row) + column * level.pitch();
          ASSERT_LT(x, size.width);
          ASSERT_LT(level.y(row), size.height);
          ++owners[size_t{level.y(row)} * size.width + x];
        }
      }
    }
    for (int count : owners) ASSERT_EQ(count, 1);
  }
}

TEST(Lifting, IsReversible) {
  for (const Size& size : kSizes) {
    if (size.width < 2) continue;
    for (const int32_t bound : {1, 1000, (1 << 27) - 1}) {
      const std::vector<int32_t> heights = randomHeights(size, bound, 1);
      std::vector<int32_t> values = heights;
      forwardLifting(values, size.width, size.height);
      inverseLifting(values, size.width, size.height);
      ASSERT_EQ(values, heights) << size.width << " x " << size.height;
    }
  }
}

TEST(Lifting, ConstantsHaveNoDetails) {
  for (const Size& size : kSizes) {
    if (size.width < 2) continue;
    std::vector<int32_t> values(size_t{size.width} * size.height, 12345);
    forwardLifting(values, size.width, size.height);
    const uint32_t coarse = 1u << depthOf(size.width, size.height);
    for (uint32_t y = 0; y < size.height; ++y) {
      for (uint32_t x = 0; x < size.width; ++x) {
        const bool root = x % coarse == 0 && y % coarse == 0;
        ASSERT_EQ(values[size_t{y} * size.width + x], root ? 12345 : 0);
      }
    }
  }
}

TEST(Lifting, PredictsQuinticsInTheInterior) {
  constexpr uint32_t kSide = 65;
  std::vector<int32_t> values(kSide * kSide);
  const auto quintic = [](double x, double y) {
    return std::pow(x, 5) - 3 * x * x * y * y * y + 40 * x * y;
  };
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      values[y * kSide + x] =
          static_cast<int32_t>(std::lround(quintic(0.5 * x - 16, 0.5 * y - 16)));
    }
  }
  forwardLifting(values, kSide, kSide);
  for (uint32_t y = 12; y < kSide - 12; ++y) {
    for (uint32_t x = 12; x < kSide - 12; ++x) {
      if ((x + y) % 2 == 0) continue;
      EXPECT_LE(std::abs(values[y * kSide + x]), 1) << x << " " << y;
    }
  }
}

TEST(Lifting, StatedNormsAreTheMeasuredOnes) {
  constexpr uint32_t kSide = 257;
  for (const Level& level : levelsOf(kSide, kSide)) {
    if (level.kind == LevelKind::kRoots || level.step > 16) continue;
    const uint32_t row = level.shape.rows / 2, column = level.shape.columns[row % 2] / 2;
    std::vector<int32_t> values(kSide * kSide, 0);
    values[level.y(row) * kSide + level.firstX(row) + column * level.pitch()] = 1 << 20;
    inverseLifting(values, kSide, kSide);
    double energy = 0;
    for (int32_t v : values) energy += std::pow(v / 1048576.0, 2);
    EXPECT_NEAR(8 * std::log2(energy), logNormOf(level), 0.51) << "step " << level.step;
  }
}

TEST(GeometryTrack, IsLosslessAtItsEnd) {
  for (const Size& size : kSizes) {
    if (size.width < 2) continue;
    for (const int32_t bound : {1, 300, (1 << 26) - 1}) {
      const std::vector<int32_t> heights = randomHeights(size, bound, 2);
      const EncodedTrack track = encodeGeometry(heights, size.width, size.height, UINT64_MAX);
      ASSERT_TRUE(track.complete);
      EXPECT_EQ(decodeGeometry(track.codeword, track.planes, size.width, size.height).heights,
                heights);
    }
  }
}

TEST(GeometryTrack, StopsSoonAfterItsLimitWithTheSameBytes) {
  const Size size{130, 70};
  const std::vector<int32_t> heights = randomHeights(size, 500, 3);
  const EncodedTrack full = encodeGeometry(heights, size.width, size.height, UINT64_MAX);
  const EncodedTrack cut = encodeGeometry(heights, size.width, size.height, 2000);
  ASSERT_FALSE(cut.complete);
  ASSERT_GE(cut.codeword.size(), 2000u);
  EXPECT_TRUE(std::equal(cut.codeword.begin(), cut.codeword.begin() + 2000, full.codeword.begin()));
}

TEST(GeometryTrack, StatedDistortionIsCloseToTheRealOne) {
  // Smooth heights in fine units, where the rounding of the lifting does not matter.
  const Size size{129, 97};
  std::vector<int32_t> heights(size_t{size.width} * size.height);
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x) {
      heights[size_t{y} * size.width + x] = static_cast<int32_t>(
          1e6 * (std::sin(0.13 * x) + std::sin(0.09 * y + 0.03 * x) + std::sin(0.011 * x * y)));
    }
  }
  const EncodedTrack track = encodeGeometry(heights, size.width, size.height, UINT64_MAX);
  for (size_t i = 5; i + 1 < track.points.size(); i += 9) {
    if (track.points[i].distortion < 100.0 * static_cast<double>(heights.size()))
      break;  // rounding noise
    const auto decoded = decodeGeometry(std::span(track.codeword).first(track.points[i].bytes),
                                        track.planes, size.width, size.height)
                             .heights;
    double squares = 0;
    for (size_t k = 0; k < heights.size(); ++k) squares += std::pow(decoded[k] - heights[k], 2);
    const double ratio = squares / track.points[i].distortion;
    EXPECT_GT(ratio, 0.5) << i;
    EXPECT_LT(ratio, 1.7) << i;
  }
}

TEST(GeometryTrack, AnyBytesDecode) {
  std::mt19937 random(4);
  for (int run = 0; run < 50; ++run) {
    std::vector<uint8_t> bytes(random() % 600);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    const auto decoded = decodeGeometry(bytes, static_cast<int>(random() % 31), 23, 40);
    EXPECT_EQ(decoded.heights.size(), 23u * 40u);
  }
}

}  // namespace
}  // namespace tetrakis
