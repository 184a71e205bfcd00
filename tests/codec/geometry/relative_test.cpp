// SPDX-License-Identifier: Apache-2.0
// Corrections from relative steps. Whole streams: tests/api/relative_heights_test.cpp.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "codec/geometry/relative/relative_encoder.hpp"
#include "codec/geometry/relative/relative_pass.hpp"
#include "conformance/samples/offset_heights.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "tests/codec/geometry/restored_samples.hpp"

namespace tetrakis::test {
namespace {

std::vector<uint8_t> codewordOf(const samples::Raster& raster, const DecodedHeights& near,
                                const GeometryHeader& header, const RelativeSteps& relative) {
  const DecodedGeometry& geometry = near.geometry;
  const std::vector<int32_t> steps = wholeSteps(geometry);
  return encodeRelative(heightsOf(raster), {steps, geometry.extent(), geometry.valid},
                        {0, 0, geometry.width, geometry.height}, header, relative);
}

/// Whatever the samples, the heights and the step are.
TEST(Relative, RestoresAnySamples) {
  uint32_t seed = 0;
  for (const tks_sample type : {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32}) {
    for (const double step : {1.0, 0.2, 1e-310, 3e38, 1.7e308}) {
      for (const uint8_t quarters : {uint8_t{1}, uint8_t{4}}) {
        SCOPED_TRACE(std::to_string(type) + ", step " + std::to_string(step));
        const samples::Raster raster = anySamples(type, ++seed);
        const DecodedHeights near = roughly(seed, static_cast<int>(seed % 5), seed % 2 == 0);
        const GeometryHeader header = headerOf(type);
        const std::vector<uint8_t> codeword = codewordOf(raster, near, header, {step, quarters});
        const DecodedHeights restored = restoreRelative(near, header, {step, quarters}, codeword);
        const std::vector<std::byte> out = samplesOf(restored, header);
        const size_t bytes = tks_sample_bytes(type);
        for (size_t i = 0; i < kSamples; ++i) {
          const bool valid = near.geometry.valid.empty() || near.geometry.valid[i] != 0;
          if (!valid) continue;
          ASSERT_EQ(std::memcmp(&out[i * bytes], &raster.data[i * bytes], bytes), 0) << i;
        }
      }
    }
  }
}

TEST(Relative, PrefixesRestoreTheFirstSamples) {
  const samples::Raster raster = anySamples(TKS_F32, 7);
  const DecodedHeights near = roughly(7, 2, true);
  const GeometryHeader header = headerOf(TKS_F32);
  const RelativeSteps relative{0.3, 1};
  const std::vector<uint8_t> codeword = codewordOf(raster, near, header, relative);
  expectPrefixesRestoreTheFirst(raster, near, header, codeword, [&](auto prefix) {
    return restoreRelative(near, header, relative, prefix);
  });
}

/// Whole metres above a smooth surface, which many roundings of floats tell better than one.
TEST(Relative, RoundingsAboveAGeoidAreForetold) {
  constexpr uint32_t kSide = 200;
  GeometryHeader header = headerOf(TKS_F32);
  header.width = header.height = kSide;
  header.base = 40;
  header.step = 1;
  DecodedHeights near;
  near.geometry.width = near.geometry.height = kSide;
  const samples::Raster raster = floatsOf(kSide, kSide, [&](uint32_t x, uint32_t y) {
    const auto metres = static_cast<int32_t>(samples::hash(x / 5, y / 5, 89) % 4);
    near.geometry.heights.push_back(metres);
    return 40.0123 + 0.0013 * x + 0.0007 * y + 1e-7 * x * y + metres;
  });
  const std::vector<uint8_t> codeword = codewordOf(raster, near, header, {1, 1});
  EXPECT_LT(static_cast<double>(8 * codeword.size()), 0.55 * kSide * kSide) << "of one: 0.8 bits";
}

TEST(Relative, AnyBytesDecode) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const auto type = static_cast<tks_sample>(seed % 7);
    std::vector<uint8_t> noise(samples::hash(seed, 0, 84) % 3000);
    for (size_t i = 0; i < noise.size(); ++i)
      noise[i] = static_cast<uint8_t>(samples::hash(static_cast<uint32_t>(i), seed, 85));
    const double step = std::ldexp(1.0, static_cast<int>(seed * 35) - 1074);
    const DecodedHeights decoded =
        restoreRelative(roughly(seed, static_cast<int>(seed % 9), seed % 3 == 0), headerOf(type),
                        {step, static_cast<uint8_t>(1 + seed % 4)}, noise);
    EXPECT_EQ(decoded.corrections.size(), kSamples);
    samplesOf(decoded, headerOf(type));
  }
}

samples::Raster offsetHeights(samples::OffsetKind kind, uint32_t width, uint32_t height) {
  const samples::Raster steps =
      samples::make({samples::Pattern::kRidges, width, height, 1, TKS_U16, 5});
  samples::Raster low = steps;  // some thousand steps
  for (size_t i = 0; i < size_t{width} * height; ++i) {
    uint16_t step = 0;
    std::memcpy(&step, steps.data.data() + 2 * i, 2);
    step >>= 4;
    std::memcpy(low.data.data() + 2 * i, &step, 2);
  }
  return samples::withOffsets(low, kind);
}

TEST(RelativeStep, IsFound) {
  for (const samples::OffsetKind kind : samples::kOffsetKinds) {
    for (const uint32_t width : {20u, 130u, 700u}) {
      const samples::Raster raster = offsetHeights(kind, width, 120);
      EXPECT_EQ(findRelativeStep(heightsOf(raster), {}), samples::stepOf(kind)) << width;
    }
  }
}

/// Where few samples are followed by a jump, and most jumps lie between squares out of LERC.
TEST(RelativeStep, IsFoundOnFlatGround) {
  const samples::Raster raster = floatsOf(300, 200, [](uint32_t x, uint32_t y) {
    const double hill = 0.9 * std::sin(0.02 * x) + 1.1 * std::cos(0.03 * y);
    return samples::offsetAt(samples::OffsetKind::kSquares, x, y, 300) + 2 * std::round(hill / 2);
  });
  EXPECT_EQ(findRelativeStep(heightsOf(raster), {}), 2);
}

/// Jumps of whole metres are three, four, seven and ten feet, and seldom one or two.
TEST(RelativeStep, IsFoundWhereSingleStepsAreRare) {
  const samples::Raster raster = floatsOf(200, 200, [](uint32_t x, uint32_t y) {
    const double metres = std::round(60 * std::sin(0.05 * x) * std::cos(0.04 * y)) + 1200 +
                          samples::hash(x, y, 88) % 8;
    return 0.3048 * std::round(metres / 0.3048) + 30.1 + 0.0013 * x;
  });
  EXPECT_EQ(findRelativeStep(heightsOf(raster), {}), 0.3048);
}

/// Voids hide some samples, and one in thirty was measured by somebody else.
TEST(RelativeStep, IsFoundBesideOtherSamples) {
  for (const samples::OffsetKind kind : samples::kOffsetKinds) {
    samples::Raster raster = offsetHeights(kind, 200, 200);
    std::vector<uint8_t> valid(200 * 200, 1);
    for (uint32_t i = 0; i < valid.size(); ++i) {
      if (samples::hash(i, 1, 86) % 100 == 0) {
        const auto other = static_cast<float>(samples::hash(i, 2, 86) * 0x1p-22);
        std::memcpy(raster.data.data() + size_t{4} * i, &other, 4);
      }
      valid[i] = samples::hash(i / 16, 3, 86) % 8 != 0;
    }
    EXPECT_EQ(findRelativeStep(heightsOf(raster), valid), samples::stepOf(kind));
  }
}

TEST(RelativeStep, OtherHeightsHaveNone) {
  const auto made = [](auto height) {
    samples::Raster raster{150, 130, 1, TKS_F32, {}};
    for (uint32_t y = 0; y < raster.height; ++y) {
      for (uint32_t x = 0; x < raster.width; ++x) {
        const auto sample = static_cast<float>(height(double(x), double(y)));
        const auto* bytes = reinterpret_cast<const std::byte*>(&sample);
        raster.data.insert(raster.data.end(), bytes, bytes + sizeof sample);
      }
    }
    return findRelativeStep(heightsOf(raster), {});
  };
  const auto bits = [](double x, double y) {
    return samples::hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 87);
  };
  EXPECT_EQ(made([&](double x, double y) { return bits(x, y) * 0x1p-32; }), 0);
  EXPECT_EQ(made([](double, double) { return 17.3; }), 0);
  EXPECT_EQ(made([](double x, double y) { return 0.37 * x - 1.1 * y; }), 0);
  EXPECT_EQ(made([&](double x, double y) {
              return 500 + 100 * std::sin(0.031 * x) * std::cos(0.043 * y) + bits(x, y) * 0x1p-32;
            }),
            0);
  EXPECT_EQ(made([](double x, double y) { return std::hypot(x, y); }), 0);
  EXPECT_EQ(made([](double, double) { return std::numeric_limits<double>::quiet_NaN(); }), 0);
  EXPECT_EQ(made([&](double x, double y) { return std::bit_cast<float>(bits(x, y)); }), 0);
}

TEST(RelativeStep, SmallPlanesHaveNone) {
  for (const uint32_t side : {1u, 2u, 3u}) {
    const samples::Raster raster = offsetHeights(samples::OffsetKind::kGeoid, side, 3);
    EXPECT_EQ(findRelativeStep(heightsOf(raster), {}), 0);
  }
}

}  // namespace
}  // namespace tetrakis::test
