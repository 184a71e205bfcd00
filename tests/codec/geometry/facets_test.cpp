// SPDX-License-Identifier: Apache-2.0
// Corrections from facets. Whole streams: tests/api/facet_heights_test.cpp.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "codec/geometry/facets/facet_coder.hpp"
#include "codec/geometry/facets/facet_rows.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "conformance/samples/facets.hpp"
#include "tests/codec/geometry/restored_samples.hpp"

namespace tetrakis::test {
namespace {

std::vector<uint8_t> codewordOf(const samples::Raster& raster, const DecodedHeights& near,
                                const GeometryHeader& header, int unit) {
  const DecodedGeometry& geometry = near.geometry;
  const std::vector<int32_t> steps = wholeSteps(geometry);
  return encodeFacets(heightsOf(raster), {steps, geometry.extent(), geometry.valid},
                      {0, 0, geometry.width, geometry.height}, header, unit);
}

/// Whatever the samples, the heights and the unit are.
TEST(Facets, RestoreAnySamples) {
  uint32_t seed = 0;
  for (const int unit : {1, 2, 60, 104, 200, 254}) {
    for (const double step : {1.0, 0.2, 1e-310, 3e38, 1.7e308}) {
      SCOPED_TRACE(std::to_string(unit) + ", step " + std::to_string(step));
      const samples::Raster raster = anySamples(TKS_F32, ++seed);
      const DecodedHeights near = roughly(seed, static_cast<int>(seed % 5), seed % 2 == 0);
      GeometryHeader header = headerOf(TKS_F32);
      header.step = step;
      const std::vector<uint8_t> codeword = codewordOf(raster, near, header, unit);
      const DecodedHeights restored = restoreFacets(near, header, unit, codeword);
      const std::vector<std::byte> out = samplesOf(restored, header);
      for (size_t i = 0; i < kSamples; ++i) {
        if (!near.geometry.valid.empty() && !near.geometry.valid[i]) continue;
        ASSERT_EQ(std::memcmp(&out[4 * i], &raster.data[4 * i], 4), 0) << i;
      }
    }
  }
}

TEST(Facets, PrefixesRestoreTheFirstSamples) {
  const samples::Raster raster = samples::facets(kWidth, kHeight, 5.3);
  const DecodedHeights near = roughly(7, 2, true);
  const GeometryHeader header = headerOf(TKS_F32);
  const std::vector<uint8_t> codeword = codewordOf(raster, near, header, 98);
  expectPrefixesRestoreTheFirst(raster, near, header, codeword, [&](auto prefix) {
    return restoreFacets(near, header, 98, prefix);
  });
}

TEST(Facets, AnyBytesDecode) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    std::vector<uint8_t> noise(samples::hash(seed, 0, 84) % 3000);
    for (size_t i = 0; i < noise.size(); ++i)
      noise[i] = static_cast<uint8_t>(samples::hash(static_cast<uint32_t>(i), seed, 85));
    GeometryHeader header = headerOf(TKS_F32);
    header.step = std::ldexp(1.0, static_cast<int>(seed * 35) - 1074);
    const int unit = static_cast<int>(1 + samples::hash(seed, 0, 86) % 254);
    const DecodedHeights decoded = restoreFacets(
        roughly(seed, static_cast<int>(seed % 9), seed % 3 == 0), header, unit, noise);
    EXPECT_EQ(decoded.corrections.size(), kSamples);
    samplesOf(decoded, header);
  }
}

/// Inside of a facet a sample takes less than a bit, although floats around it are rounded.
TEST(Facets, TakeLessThanABitASample) {
  constexpr uint32_t kSide = 300;
  GeometryHeader header = headerOf(TKS_F32);
  header.width = header.height = kSide;
  const samples::Raster raster = samples::facets(kSide, kSide, 40.7);
  DecodedHeights near;
  near.geometry.width = near.geometry.height = kSide;
  near.geometry.heights.assign(size_t{kSide} * kSide, 100);
  const int unit = FacetUnit::exponentFor(256);
  const std::vector<uint8_t> codeword = codewordOf(raster, near, header, unit);
  EXPECT_LT(static_cast<double>(8 * codeword.size()), 0.8 * kSide * kSide) << "of a float's 32";
}

/// A multiple is nearest to the float that it comes from, and sums of floats to what doubles say.
TEST(FacetUnit, NearestFloatsAreThoseOfDoubles) {
  std::mt19937 source(5);
  for (int round = 0; round < 20000; ++round) {
    const auto sample = std::bit_cast<float>(static_cast<uint32_t>(source()));
    if (!std::isfinite(sample)) continue;
    const int exponent = FacetUnit::exponentFor(std::abs(sample));
    const FacetUnit unit(exponent);
    ASSERT_EQ(fromOrder<float>(unit.nearest(unit.multiplesOf(sample)).order), sample);
    const auto beside = static_cast<int64_t>(source()) - (int64_t{1} << 31);
    const int64_t multiples = unit.multiplesOf(sample) + beside;
    const double exact = std::ldexp(static_cast<double>(multiples), exponent - 150);
    const auto largest = static_cast<double>(std::numeric_limits<float>::max());
    const NearestFloat near = unit.nearest(multiples);
    const auto found = static_cast<double>(fromOrder<float>(near.order));
    if (std::abs(exact) > largest) continue;
    // A double holds 53 of the 60 bits: only its own rounding may decide otherwise, at a half.
    const double spacing = std::ldexp(1, spacingExponent(static_cast<float>(found)));
    ASSERT_LE(std::abs(found - exact), 0.5 * spacing * (1 + 1e-9)) << sample << " + " << beside;
    if (near.place > 0) {
      ASSERT_EQ(near.below, exact < found);
    }
  }
}

TEST(FacetUnit, ExtremesAreFinite) {
  for (const int exponent : {1, 100, 254}) {
    const FacetUnit unit(exponent);
    for (const float sample :
         {0.f, -0.f, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min(),
          std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
          std::numeric_limits<float>::quiet_NaN()}) {
      const int64_t multiples = unit.multiplesOf(sample);
      EXPECT_LT(std::abs(multiples), int64_t{1} << 60);
      EXPECT_TRUE(std::isfinite(fromOrder<float>(unit.nearest(3 * multiples).order)));
      EXPECT_GE(unit.halfSpacing(sample), 0);
    }
  }
}

TEST(FacetShare, IsThatOfSamplesBesideEdges) {
  const auto beyond = [](const samples::Raster& raster) {
    return findFacets(heightsOf(raster), {}).beyond;
  };
  EXPECT_LT(beyond(samples::facets(400, 300, 60.3)), 0.02);
  EXPECT_LT(beyond(samples::facets(400, 300, 20.3)), 0.1);
  EXPECT_LT(beyond(samples::facets(1, 300, 20.3)), 0.2);
  EXPECT_LT(beyond(samples::facets(300, 1, 20.3)), 0.2);
  EXPECT_GT(beyond(floatsOf(300, 200,
                            [](uint32_t x, uint32_t y) {
                              return 500 + 90 * std::sin(0.031 * x) * std::cos(0.043 * y);
                            })),
            0.9);
  EXPECT_GT(
      beyond(floatsOf(300, 200,
                      [](uint32_t x, uint32_t y) { return samples::hash(x, y, 87) * 0x1p-32; })),
      0.9);
}

}  // namespace
}  // namespace tetrakis::test
