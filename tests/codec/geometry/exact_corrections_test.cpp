// SPDX-License-Identifier: Apache-2.0
// Corrections that make heights whole steps again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::test {
namespace {

constexpr Extent kPlane = {83, 61};
constexpr int kFractionBits = 4;

/// Steps, and what a decoder has of them.
struct Cut {
  std::vector<int32_t> steps, heights;
};

/// error: of a sample, in units of 2^-kFractionBits.
Cut cutOf(const std::function<double(double x, double y)>& error) {
  Cut cut;
  for (uint32_t y = 0; y < kPlane.height; ++y) {
    for (uint32_t x = 0; x < kPlane.width; ++x) {
      cut.steps.push_back(static_cast<int32_t>(samples::hash(x, y, 91) % 5000));
      const auto off = static_cast<int32_t>(std::lround(error(x, y)));
      cut.heights.push_back(cut.steps.back() * (1 << kFractionBits) - off);
    }
  }
  return cut;
}

/// Those that are decided.
std::vector<int32_t> decoded(std::span<const uint8_t> codeword, PlaneView<const int32_t> heights,
                             int fraction_bits) {
  std::vector<int32_t> steps;
  decodeExactSteps(codeword, heights, fraction_bits,
                   [&](size_t first, std::span<const int32_t> row) {
                     EXPECT_EQ(first, steps.size());
                     steps.insert(steps.end(), row.begin(), row.end());
                   });
  return steps;
}

/// Of any steps, beside any heights, in rows as far as a prefix goes.
TEST(ExactCorrections, ComeBackAndPrefixesAgree) {
  for (uint32_t seed = 0; seed < 24; ++seed) {
    const int bits = 1 + static_cast<int>(seed * 31 / 23),
              fraction_bits = static_cast<int>(seed % 5);
    std::vector<int32_t> steps, heights;
    std::vector<uint8_t> valid;
    for (uint32_t i = 0; i < kPlane.samples(); ++i) {
      valid.push_back(seed % 3 > 0 || samples::hash(i, seed, 92) % 4 > 0);
      steps.push_back(valid.back() ? static_cast<int32_t>(samples::hash(i, seed, 93)) >> (32 - bits)
                                   : 0);
      heights.push_back(static_cast<int32_t>(samples::hash(i, seed, 94)) >> (seed % 8));
    }
    const PlaneView<const int32_t> plane(heights, kPlane, valid);
    const std::vector<uint8_t> codeword = encodeExactSteps(steps, plane, fraction_bits);
    ASSERT_EQ(decoded(codeword, plane, fraction_bits), steps) << seed;
    const std::span<const uint8_t> half = std::span(codeword).first(codeword.size() / 2);
    const std::vector<int32_t> some = decoded(half, plane, fraction_bits);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), steps.begin())) << seed;
    EXPECT_GT(some.size(), kPlane.samples() / 4) << seed;
  }
}

TEST(ExactCorrections, AnyBytesDecode) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    std::vector<uint8_t> noise(samples::hash(seed, 0, 95) % 3000);
    for (size_t i = 0; i < noise.size(); ++i)
      noise[i] = static_cast<uint8_t>(samples::hash(static_cast<uint32_t>(i), seed, 96));
    std::vector<int32_t> heights;
    for (uint32_t i = 0; i < kPlane.samples(); ++i)
      heights.push_back(static_cast<int32_t>(samples::hash(i, seed, 97)));
    decoded(noise, {heights, kPlane, {}}, static_cast<int>(seed % 9));
  }
}

double bitsOf(const Cut& cut) {
  const auto bytes = encodeExactSteps(cut.steps, {cut.heights, kPlane, {}}, kFractionBits).size();
  return 8. * static_cast<double>(bytes) / static_cast<double>(kPlane.samples());
}

/// Errors as they come, that nothing foretells.
double noise(double x, double y) {
  return samples::hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 98) * 0x1p-32 - 0.5;
}

/// What a cut has smoothed away, and what its filters leave, is known from the samples before.
TEST(ExactCorrections, ErrorsThatFollowOthersTakeFewBits) {
  const double unlike = bitsOf(cutOf([&](double x, double y) { return 90 * noise(x, y); }));
  EXPECT_GT(unlike, 2);
  const double smooth = bitsOf(cutOf(
      [&](double x, double y) { return 45 * std::sin(0.31 * x + 0.1 * y) + 4 * noise(x, y); }));
  EXPECT_LT(smooth, 0.75);
  const double alternating = bitsOf(cutOf([&](double x, double y) {
    return 45 * std::cos(M_PI * x) * std::cos(0.2 * y) + 4 * noise(x, y);
  }));
  EXPECT_LT(alternating, 0.75);
}

/// Near the middle of two steps a height says less of its step than beside one.
TEST(ExactCorrections, FractionsSayWhichStepsAreSure) {
  const auto quarter = [](double x, double y) {
    return samples::hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 99) % 4;
  };
  // A quarter of the samples lies 9/16 of a step off, the others an eighth.
  const double told = bitsOf(cutOf([&](double x, double y) {
    const double side = samples::hash(static_cast<uint32_t>(x + y), 5, 99) % 2 == 0 ? 1 : -1;
    return side * (quarter(x, y) == 0 ? 9 : 2);
  }));
  EXPECT_LT(told, 0.3) << "though the entropy of which samples are corrected is 0.81";
}

/// steps(x, y), beside heights that are off by up to three steps.
double bitsOfSteps(const std::function<int32_t(int32_t x, int32_t y)>& steps) {
  Cut cut = cutOf([](double x, double y) { return 96 * noise(x, y); });
  for (uint32_t i = 0; i < kPlane.samples(); ++i) {
    const int32_t off = cut.steps[i] * (1 << kFractionBits) - cut.heights[i];
    cut.steps[i] =
        steps(static_cast<int32_t>(i % kPlane.width), static_cast<int32_t>(i / kPlane.width));
    cut.heights[i] = cut.steps[i] * (1 << kFractionBits) - off;
  }
  return bitsOf(cut);
}

/// Steps that are those of neighbours, lie in planes or are multiples need no near heights.
TEST(ExactCorrections, NeighboursSayWhichStepsAreLikely) {
  const auto any = [](int32_t x, int32_t y) {
    return static_cast<int32_t>(
        samples::hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 100) % 5000);
  };
  const double unlike = bitsOfSteps(any);
  EXPECT_GT(unlike, 2.5);
  // Nearest neighbours of a grid that is turned.
  EXPECT_LT(
      bitsOfSteps([&](int32_t x, int32_t y) { return any((5 * x + y) / 16, (5 * y - x) / 16); }),
      unlike / 2);
  EXPECT_LT(bitsOfSteps([&](int32_t x, int32_t y) { return any(x / 20, 0) % 7 * x + 3 * y; }),
            unlike / 3);
  EXPECT_LT(
      bitsOfSteps([&](int32_t x, int32_t y) { return any(x / 8, y / 8) + any(x, y) % 2 * 6; }),
      unlike / 1.5);
}

}  // namespace
}  // namespace tetrakis::test
