// SPDX-License-Identifier: Apache-2.0
// Which heights are coded as a cut with exact corrections behind it.
#include "codec/geometry/coding_choice/cuts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::test {
namespace {

constexpr Extent kCopied = {300, 280};
constexpr int kRangeBits = 12;

using Surface = std::function<double(double x, double y)>;

double noise(int64_t x, int64_t y) {
  return samples::hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 61) * 0x1p-32 - 0.5;
}

double rough(double x, double y) {
  return 900 * std::sin(0.013 * x) * std::cos(0.017 * y) + 120 * std::sin(0.11 * x + 0.07 * y) +
         12 * noise(std::lround(x), std::lround(y));
}

/// A grid of the surface.
struct Grid {
  HeightSteps steps;

  explicit Grid(const Surface& surface) {
    steps.range_bits = kRangeBits;
    for (uint32_t y = 0; y < kCopied.height; ++y)
      for (uint32_t x = 0; x < kCopied.width; ++x)
        steps.steps.push_back(static_cast<int32_t>(std::lround(surface(x, y))));
  }
  PlaneView<const int32_t> plane() const { return {steps.steps, kCopied}; }

  EncodedTrack coded(Purpose purpose, GeometryHeader& header) const {
    header.width = kCopied.width;
    header.height = kCopied.height;
    header.wavelet = chooseWavelet(plane(), kRangeBits, purpose);
    EncodedTrack track = encodeCoefficients(plane(), header.wavelet, {}).front();
    header.planes = static_cast<uint8_t>(track.planes);
    return track;
  }
  uint64_t wholeBytes() const {
    GeometryHeader header;
    return coded(Purpose::kLossless, header).codeword.size();
  }
  /// What a cut takes that leaves such an error, with its corrections.
  uint64_t bytesBehind(double mean_square) const {
    GeometryHeader header;
    const EncodedTrack track = coded(Purpose::kLossy, header);
    const FlatAreas none;
    CorrectedCut cut(steps, none, header, track, 0);
    return cut.total(cut.bytesFor(mean_square));
  }
};

/// Kinds of which neighbours know more than a transform does.
TEST(ExactCut, IsThereForCopiesAndForMultiplesAndTellsTheirBytes) {
  const Surface turned = [](double x, double y) {
    return rough(std::floor(0.4 * x + 0.15 * y), std::floor(0.4 * y - 0.15 * x));
  };
  const Surface tens = [](double x, double y) {
    return x < 150 ? rough(x, y) : 10 * std::round(rough(x, y) / 10);
  };
  for (const Surface& surface : {turned, tens}) {
    const Grid grid(surface);
    const uint64_t whole = grid.wholeBytes();
    const auto cut = chooseExactCut(grid.plane(), kRangeBits, whole);
    ASSERT_TRUE(cut);
    const auto bytes = static_cast<double>(grid.bytesBehind(cut->mean_square));
    EXPECT_LT(bytes, 0.9 * static_cast<double>(whole));
    EXPECT_NEAR(cut->bytes / bytes, 1, 0.2);
  }
}

TEST(ExactCut, IsNotThereForTerrain) {
  const Grid terrain(rough);
  EXPECT_FALSE(chooseExactCut(terrain.plane(), kRangeBits, terrain.wholeBytes()));
}

/// Prefixes of an early cut are worth less than those of a late one.
TEST(ExactCut, LosesByEarlyCuts) {
  EXPECT_GT(exactWorth(1000, 10), exactWorth(1000, 100));
  EXPECT_DOUBLE_EQ(exactWorth(1000, 1000), 1000);
  EXPECT_TRUE(isWorth(exactWorth(1000, 1000), 1000));
  EXPECT_FALSE(isWorth(exactWorth(1000, 400), 1000));
}

}  // namespace
}  // namespace tetrakis::test
