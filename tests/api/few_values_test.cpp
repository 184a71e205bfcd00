// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights that have few values, which a table holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/few_values.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::FewValues;
using samples::make;
using samples::Pattern;
using samples::Raster;

std::string nameOf(FewValues kind) {
  constexpr const char* kNames[] = {"feet", "rescaled", "rare", "stretched"};
  return kNames[static_cast<size_t>(kind)];
}

/// Beside the same terrain in whole numbers, the values cost their table, and exceptions.
TEST(FewValues, TakeLittleMoreThanWholeNumbers) {
  const Raster whole = make({Pattern::kRidges, 150, 140, 1, TKS_U8, 3});
  const size_t plain = encode(&whole, nullptr, lossless()).size();
  for (const FewValues kind : samples::kFewValues) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withFewValues(whole, kind);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_EQ(Stream(stream).info().lossless, 1);
    const size_t exceptions = kind == FewValues::kRare ? 150 * 140 / 100 * 4 : 0;
    EXPECT_LT(stream.size(), plain + plain / 50 + 400 + exceptions);
  }
}

/// Both are 0, but other bits.
TEST(FewValues, MayBeZeroAndMinusZero) {
  Raster heights = make({Pattern::kFlat, 64, 64, 1, TKS_F32});
  for (size_t i = 0; i < 64 * 64; ++i) {
    const float value = samples::hash(static_cast<uint32_t>(i), 3, 1) % 2 == 0 ? 0.0f : -0.0f;
    std::memcpy(heights.data.data() + 4 * i, &value, 4);
  }
  EXPECT_TRUE(Stream(encode(&heights, nullptr, lossless())).heights() == heights.data);
}

/// Lossy heights know no table, but lossless ones may serve their targets.
TEST(FewValues, NoTargetTakesMoreBytesThanTheLastBit) {
  const Raster whole = make({Pattern::kRidges, 150, 140, 1, TKS_U8, 3});
  for (const FewValues kind : samples::kFewValues) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withFewValues(whole, kind);
    const size_t most = encode(&heights, nullptr, lossless()).size() + 16;
    EXPECT_LE(encode(&heights, nullptr, budget(3 * most)).size(), most);
    tks_encode_options psnr = budget(0), bound = budget(0);
    psnr.psnr = 200;
    bound.max_error = 1e-3;
    EXPECT_LE(encode(&heights, nullptr, psnr).size(), most);
    EXPECT_LE(encode(&heights, nullptr, bound).size(), most);
  }
}

/// Rough tenths of a metre above another datum, as floats, of which lossy coding makes less than
/// twice the bytes of exact ones.
Raster tenths(uint32_t width, uint32_t height) {
  const Raster whole = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
  Raster heights = make({Pattern::kFlat, width, height, 1, TKS_F32});
  for (size_t i = 0; i < size_t{width} * height; ++i) {
    const double steps = std::round(sampleAt(whole.data, TKS_I16, i) / 16) +
                         samples::hash(static_cast<uint32_t>(i), 5, 2) % 512;
    const float metres = static_cast<float>(steps / 10) + 41.237f;
    std::memcpy(heights.data.data() + 4 * i, &metres, 4);
  }
  return heights;
}

TEST(FewValues, AreExactInTwiceTheirBytes) {
  const Raster heights = tenths(150, 140);
  const Bytes stream = encode(&heights, nullptr, lossless());
  ASSERT_GT(readHeader(stream)->header.layers.table_bytes, 0u);
  for (const size_t times : {2, 3, 10}) {
    const Bytes budgeted = encode(&heights, nullptr, budget(times * stream.size() + 32));
    EXPECT_LE(budgeted.size(), stream.size() + 16) << times;
    EXPECT_TRUE(Stream(budgeted).heights() == heights.data) << times;
  }
}

/// Squared error of a prefix.
double squaresOf(const Raster& truth, Prefix prefix) {
  const std::vector<std::byte> shown = Stream(prefix).heights();
  double squares = 0;
  for (size_t i = 0; i < truth.width * size_t{truth.height}; ++i) {
    const double error = sampleAt(shown, truth.sample, i) - sampleAt(truth.data, truth.sample, i);
    squares += error * error;
  }
  return squares;
}

/// Square roots over 16 bits: no line comes near to the values.
Raster squareRoots(uint32_t width, uint32_t height) {
  Raster heights = make({Pattern::kRidges, width, height, 1, TKS_U16, 3});
  for (size_t i = 0; i < size_t{width} * height; ++i) {
    const double value = sampleAt(heights.data, TKS_U16, i);
    const auto root = static_cast<uint16_t>(std::lround(std::sqrt(std::round(value / 40)) * 900));
    std::memcpy(heights.data.data() + 2 * i, &root, 2);
  }
  return heights;
}

/// The table comes when it is worth its bytes: halves and quarters of the stream are good without.
TEST(FewValues, PrefixesAreGoodBeforeTheTable) {
  const Raster whole = make({Pattern::kRidges, 150, 140, 1, TKS_U8, 3});
  for (const Raster& heights :
       {samples::withFewValues(whole, FewValues::kFeet), squareRoots(150, 140)}) {
    const Bytes stream = encode(&heights, nullptr, lossless());
    const GeometryLayers layers = readHeader(stream)->header.layers;
    ASSERT_GT(layers.table_bytes, 0u);
    EXPECT_GT(layers.table_after, 0u);
    for (const size_t part : {8, 4, 2}) {
      const size_t bytes = stream.size() / part;
      const Bytes lossy = encode(&heights, nullptr, budget(bytes));
      EXPECT_LT(squaresOf(heights, Prefix(stream).first(bytes)), 2 * squaresOf(heights, lossy))
          << part;
    }
  }
}

/// Terrain with holes of -9999 that nobody declared.
Raster undeclaredHoles(uint32_t width, uint32_t height) {
  Raster heights = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
  for (size_t i = 0; i < size_t{width} * height; ++i) {
    const double value = sampleAt(heights.data, TKS_I16, i);
    const auto shown = static_cast<int16_t>(value < -4000 ? -9999 : std::lround(value / 40));
    std::memcpy(heights.data.data() + 2 * i, &shown, 2);
  }
  return heights;
}

/// The table has -9999 beside the lowest ground, but for values that no sample has: a prefix that
/// misses places by a few is not to show ground as holes.
TEST(FewValues, PrefixesKeepGroundApartFromHoles) {
  const Raster heights = undeclaredHoles(150, 140);
  const Bytes stream = encode(&heights, nullptr, lossless());
  ASSERT_GT(readHeader(stream)->header.layers.table_bytes, 0u);
  EXPECT_TRUE(Stream(stream).heights() == heights.data);
  const std::vector<std::byte> half = Stream(Prefix(stream).first(stream.size() / 2)).heights();
  int holes = 0;
  for (size_t i = 0; i < size_t{150} * 140; ++i) {
    const double truth = sampleAt(heights.data, TKS_I16, i);
    holes += truth == -9999;
    if (truth > -9999) {
      ASSERT_NEAR(sampleAt(half, TKS_I16, i), truth, 300) << i;
    }
  }
  EXPECT_GT(holes, 1000);
}

TEST(FewValues, DecodeAsTheReferenceDoesInAllPrefixesAndLevels) {
  constexpr uint32_t kWidth = 53, kHeight = 43;
  const Raster whole = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_U8, 3});
  tks_encode_options regions = lossless();
  regions.regions = 16;
  for (const Raster& heights :
       {samples::withFewValues(whole, FewValues::kFeet), squareRoots(kWidth, kHeight),
        samples::withFewValues(whole, FewValues::kRare)}) {
    for (const tks_encode_options& options : {lossless(), regions}) {
      const Bytes stream = encode(&heights, nullptr, options);
      const GeometryLayers layers = readHeader(stream)->header.layers;
      EXPECT_TRUE(layers.table_bytes > 0 || layers.corrections == CorrectionKind::kRelative);
      for (size_t n = readHeader(stream)->bytes; n <= stream.size(); n += n % 11 + 1) {
        const Prefix prefix = Prefix(stream).first(n);
        for (const uint32_t level : {0u, 2u}) {
          Stream decoded(prefix);
          ASSERT_EQ(tks_set_levels(decoded.get(), level, 0), TKS_OK);
          const size_t samples =
              size_t{((kWidth - 1) >> level) + 1} * (((kHeight - 1) >> level) + 1);
          std::vector<uint8_t> shown(samples * tks_sample_bytes(heights.sample));
          ASSERT_EQ(tks_decode_heights(decoded.get(), shown.data(), shown.size()), TKS_OK);
          ASSERT_EQ(shown, reference::decode(prefix, 1 << 20, {static_cast<int>(level), 0}).heights)
              << n << ", level " << level;
        }
      }
    }
  }
}

TEST(FewValues, WindowsAreThoseOfTheWholeInAllPrefixes) {
  const Raster heights = squareRoots(90, 70);
  const Bytes stream = encode(&heights, nullptr, lossless());
  for (size_t n = readHeader(stream)->bytes; n <= stream.size(); n += 97) {
    const std::vector<std::byte> whole = Stream(Prefix(stream).first(n)).heights();
    expectHeightsWindow(Stream(Prefix(stream).first(n)), {13, 9, 31, 20}, whole);
  }
}

/// Once the table is there, a prefix shows its values: nothing lies between them.
TEST(FewValues, PrefixesShowValuesOfTheTable) {
  const Raster heights =
      samples::withFewValues(make({Pattern::kSteps, 90, 70, 1, TKS_U8, 5}), FewValues::kFeet);
  const Bytes stream = encode(&heights, nullptr, lossless());
  const auto samplesOf = [](const std::vector<std::byte>& bytes) {
    std::vector<float> out(bytes.size() / 4);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  };
  std::vector<float> values = samplesOf(heights.data);
  std::sort(values.begin(), values.end());
  const ParsedHeader header = *readHeader(stream);
  const GeometryLayers& layers = header.header.layers;
  const size_t known = header.bytes + layers.table_after + layers.table_bytes;
  for (size_t n = known + known / 50 + 40; n < stream.size(); n += 1 + stream.size() / 99) {
    Stream prefix(Prefix(stream).first(n));
    for (const float sample : samplesOf(prefix.heights()))
      ASSERT_TRUE(std::binary_search(values.begin(), values.end(), sample)) << sample;
  }
}

}  // namespace
}  // namespace tetrakis::test
