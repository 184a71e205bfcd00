// SPDX-License-Identifier: Apache-2.0
// Geometry tracks: lossless ends, limits, stated distortion, voids, the choice of filters, hostile
// bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

const std::vector<Size> kPlaneSizes = {{2, 2},   {2, 3},    {3, 2},     {2, 9},
                                       {3, 17},  {5, 5},    {8, 8},     {17, 31},
                                       {33, 65}, {3, 1000}, {300, 200}, {127, 64}};

struct Coded {
  GeometryHeader header;
  EncodedTrack track;
};

Coded encode(const Plane& heights, const Size& size, const WaveletHeader& wavelet, Mask valid = {},
             uint64_t limit = UINT64_MAX) {
  Coded coded;
  coded.header.width = size.width;
  coded.header.height = size.height;
  coded.header.wavelet = wavelet;
  coded.track = encodeCoefficients({heights, size.extent(), valid}, wavelet, {limit}).front();
  coded.header.planes = static_cast<uint8_t>(coded.track.planes);
  return coded;
}

/// With the encoder's own choice of filters.
Coded encode(const Plane& heights, const Size& size, int bits, Purpose purpose) {
  return encode(heights, size, chooseWavelet({heights, size.extent()}, bits, purpose));
}

DecodedGeometry decode(const Coded& coded, const std::vector<uint8_t>& valid = {}) {
  return decodeCoefficients(coded.header, {coded.track.codeword},
                            {sharedBits(valid, coded.header.extent())});
}

Plane waves(const Size& size, double amplitude) {
  Plane heights;
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x) {
      heights.push_back(
          static_cast<int32_t>(amplitude * (std::sin(0.13 * x) + std::sin(0.09 * y + 0.03 * x) +
                                            std::sin(0.011 * x * y))));
    }
  }
  return heights;
}

TEST(GeometryTrack, IsLosslessAtItsEnd) {
  Random random(2);
  for (const Size& size : kPlaneSizes) {
    for (const int32_t bound : {1, 300, (1 << 26) - 1}) {
      const Plane heights = randomPlane(random, size.count(), -bound, bound - 1);
      for (const Purpose purpose : {Purpose::kLossless, Purpose::kLossy}) {
        const int bits = std::bit_width(static_cast<uint32_t>(2 * bound));
        const Coded coded = encode(heights, size, bits, purpose);
        ASSERT_TRUE(coded.track.complete);
        EXPECT_EQ(wholeSteps(decode(coded)), heights) << size << ", " << bound;
      }
    }
  }
}

TEST(GeometryTrack, EveryWaveletIsLossless) {
  Random random(3);
  const Size size{45, 30};
  const Plane heights = randomPlane(random, size.count(), -3000, 3000);
  for (const WaveletSpec& spec : allSpecs()) {
    for (const int fraction_bits : {0, 1, 4, 8}) {
      WaveletHeader wavelet;
      for (size_t i = 0; i < spec.filters.size(); ++i) {
        wavelet.filters[i] = static_cast<uint8_t>(spec.filters[i]);
      }
      wavelet.fraction_bits = static_cast<uint8_t>(fraction_bits);
      wavelet.bits = static_cast<uint8_t>(13 + fraction_bits);
      EXPECT_EQ(wholeSteps(decode(encode(heights, size, wavelet))), heights) << spec;
    }
  }
}

TEST(GeometryTrack, VoidsDecodeToZeroAndTheRestExactly) {
  Random random(4);
  for (const Size& size : {Size{2, 2}, Size{17, 31}, Size{90, 70}}) {
    for (const VoidShape shape : kVoidShapes) {
      const auto valid = validity(shape, size.width, size.height);
      Plane heights = randomPlane(random, size.count(), -500, 500);
      const WaveletHeader wavelet =
          chooseWavelet({heights, size.extent(), valid}, 10, Purpose::kLossless);
      const DecodedGeometry decoded = decode(encode(heights, size, wavelet, valid), valid);
      for (size_t i = 0; i < valid.size(); ++i) {
        ASSERT_EQ(decoded.heights[i], valid[i] ? heights[i] : 0);
        ASSERT_TRUE(valid[i] || !decoded.significant[i]);
      }
    }
  }
}

/// Every vertex owns one coefficient: what is marked are the places of those that are not zero.
TEST(GeometryTrack, SignificantVerticesAreThoseOfItsCoefficients) {
  Random random(5);
  for (const Size& size : {Size{2, 5}, Size{33, 20}, Size{70, 41}}) {
    Plane heights(size.count(), 0);
    for (int i = 0; i < 6; ++i) heights[random() % heights.size()] = 40;
    const Coded coded = encode(heights, size, {{1, 1, 1}, 0, 8, 3});
    Plane plane = heights;
    forwardWavelet(uniform(FilterId::kSixTap, true, 8), Pyramid(size.extent()), plane);
    std::vector<uint8_t> expected(plane.size(), 0);
    for (const Subband& band : subbandsOf(size)) {
      forEachCoefficient(band, size.width, [&](size_t coefficient, size_t sample) {
        expected[sample] = plane[coefficient] != 0;
      });
    }
    EXPECT_EQ(decode(coded).significant, expected) << size;
  }
}

TEST(GeometryTrack, StopsSoonAfterItsLimitWithTheSameBytes) {
  Random random(6);
  const Size size{130, 70};
  const Plane heights = randomPlane(random, size.count(), -500, 499);
  const WaveletHeader wavelet = chooseWavelet({heights, size.extent()}, 10, Purpose::kLossless);
  const EncodedTrack full = encode(heights, size, wavelet).track,
                     cut = encode(heights, size, wavelet, {}, 2000).track;
  ASSERT_FALSE(cut.complete);
  ASSERT_GE(cut.codeword.size(), 2000u);
  const auto end = cut.codeword.begin() + 1990;  // the last bytes end the codeword
  EXPECT_TRUE(std::equal(cut.codeword.begin(), end, full.codeword.begin()));
}

TEST(GeometryTrack, StatedDistortionIsCloseToTheRealOne) {
  // Smooth heights in fine units, where rounding does not matter.
  const Size size{129, 97};
  const Plane heights = waves(size, 1e6);
  for (const Purpose purpose : {Purpose::kLossless, Purpose::kLossy}) {
    const Coded coded = encode(heights, size, 23, purpose);
    const auto& points = coded.track.points;
    for (size_t i = 5; i + 1 < points.size(); i += 9) {
      if (points[i].distortion < 100.0 * static_cast<double>(heights.size())) break;
      const auto decoded = decodeCoefficients(
          coded.header, {std::span(coded.track.codeword).first(points[i].bytes)});
      double squares = 0;
      for (size_t k = 0; k < heights.size(); ++k) {
        squares += std::pow(std::ldexp(decoded.heights[k], -decoded.fraction_bits) - heights[k], 2);
      }
      const double ratio = squares / points[i].distortion;
      EXPECT_GT(ratio, 0.5) << i;
      EXPECT_LT(ratio, 1.7) << i;
    }
  }
}

/// The estimate behind the choice of filters costs few bytes against coding with every filter.
TEST(GeometryTrack, FiltersAreChosenWell) {
  const Size size{160, 150};
  for (const samples::Pattern pattern : {samples::Pattern::kRidges, samples::Pattern::kSteps}) {
    Plane heights;
    for (uint32_t y = 0; y < size.height; ++y) {
      for (uint32_t x = 0; x < size.width; ++x) {
        const auto v = samples::patternValue({pattern, size.width, size.height}, x, y, 0);
        heights.push_back(static_cast<int32_t>(v >> 5));
      }
    }
    const size_t chosen = encode(heights, size, 11, Purpose::kLossless).track.codeword.size();
    for (uint8_t id = 0; id < kFilters; ++id) {
      const size_t bytes = encode(heights, size, {{id, id, id}, 0, 11}).track.codeword.size();
      EXPECT_LT(static_cast<double>(chosen), 1.01 * static_cast<double>(bytes)) << int{id};
    }
  }
}

/// Plateaus at both ends of the range, whatever its bits: no coefficient is too large for a track,
/// and no sum wraps around in what a prefix decodes to.
TEST(GeometryTrack, HighPlateausAreCodedWell) {
  const Size size{600, 590};
  for (const int bits : {8, 12, 16, 20, 21, 26}) {
    const int32_t top = (1 << (bits - 1)) - 1;
    Plane heights;
    for (uint32_t y = 0; y < size.height; ++y) {
      for (uint32_t x = 0; x < size.width; ++x) heights.push_back(3 * y < 2 * x ? top : -top);
    }
    std::vector<WaveletHeader> wavelets = {
        chooseWavelet({heights, size.extent()}, bits, Purpose::kLossy),
        chooseWavelet({heights, size.extent()}, bits, Purpose::kLossless)};
    if (bits <= 16) wavelets.push_back({{2, 2, 2}, 4, static_cast<uint8_t>(bits + 4)});
    for (const WaveletHeader& wavelet : wavelets) {
      Coded coded = encode(heights, size, wavelet);
      ASSERT_LE(coded.track.planes, kMaxPlanes) << bits;
      coded.track.codeword.resize(1500);
      const DecodedGeometry decoded = decode(coded);
      double squares = 0;
      for (size_t i = 0; i < heights.size(); ++i) {
        squares += std::pow(std::ldexp(decoded.heights[i], -decoded.fraction_bits) - heights[i], 2);
      }
      const double rmse = std::sqrt(squares / static_cast<double>(heights.size()));
      EXPECT_LT(rmse, 0.05 * top) << bits;
    }
  }
}

TEST(GeometryTrack, AnyBytesAndHeadersDecode) {
  Random random(7);
  for (int run = 0; run < 300; ++run) {
    GeometryHeader header;
    header.width = static_cast<uint32_t>(2 + random() % 40);
    header.height = static_cast<uint32_t>(2 + random() % 40);
    header.planes = static_cast<uint8_t>(random() % 31);
    for (uint8_t& filter : header.wavelet.filters) filter = static_cast<uint8_t>(random() % 4);
    header.wavelet.fraction_bits = static_cast<uint8_t>(random() % (kMaxFractionBits + 1));
    header.wavelet.bits = static_cast<uint8_t>(random() % 33);
    std::vector<uint8_t> bytes(random() % 600);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    std::vector<uint8_t> valid;
    if (run % 2 == 0) valid = validity(VoidShape::kSpeckle, header.width, header.height);
    const DecodedGeometry decoded =
        decodeCoefficients(header, {bytes}, {sharedBits(valid, header.extent())});
    EXPECT_EQ(decoded.heights.size(), size_t{header.width} * header.height);
    EXPECT_EQ(decoded.significant.size(), decoded.heights.size());
  }
}

}  // namespace
}  // namespace tetrakis::test
