// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights in whole steps above a geoid, above offsets of squares, of two surveys.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "conformance/reference_decoder.hpp"
#include "conformance/samples/offset_heights.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::OffsetKind;
using samples::Pattern;
using samples::Raster;

constexpr uint32_t kWidth = 150, kHeight = 140;

/// Some hundred steps, whole.
Raster steps() {
  Raster whole = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_U16, 3});
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    const auto step = static_cast<uint16_t>(sampleAt(whole.data, TKS_U16, i) / 64);
    std::memcpy(whole.data.data() + 2 * i, &step, 2);
  }
  return whole;
}

std::string nameOf(OffsetKind kind) {
  constexpr const char* kNames[] = {"geoid", "squares", "surveys"};
  return kNames[static_cast<size_t>(kind)];
}

/// Beside whole steps, offsets cost what floats round: two bits a sample; offsets of squares, which
/// are 1 in 64 samples, half a bit.
TEST(RelativeHeights, TakeLittleMoreThanWholeSteps) {
  const Raster whole = steps();
  const size_t plain = encode(&whole, nullptr, lossless()).size();
  for (const OffsetKind kind : samples::kOffsetKinds) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withOffsets(whole, kind);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_EQ(Stream(stream).info().lossless, 1);
    EXPECT_LT(stream.size(), plain + size_t{kWidth} * kHeight * 5 / 16);
  }
}

/// Prefixes up to the cut are those of lossy heights, and behind it rows become exact.
TEST(RelativeHeights, PrefixesComeNearer) {
  for (const OffsetKind kind : samples::kOffsetKinds) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withOffsets(steps(), kind);
    const Bytes stream = encode(&heights, nullptr, lossless());
    double before = 1e9;
    for (size_t eighths = 2; eighths <= 8; ++eighths) {
      const Bytes cut(stream.begin(),
                      stream.begin() + static_cast<ptrdiff_t>(stream.size() * eighths / 8));
      const double rmse = rmseOf(heights, Stream(cut).heights());
      EXPECT_LE(rmse, before * 1.02) << eighths;
      before = rmse;
    }
    EXPECT_EQ(before, 0);
    const Bytes half(stream.begin(), stream.begin() + static_cast<ptrdiff_t>(stream.size() / 2));
    const Bytes lossy = encode(&heights, nullptr, budget(half.size()));
    EXPECT_LT(rmseOf(heights, Stream(half).heights()),
              1.1 * rmseOf(heights, Stream(lossy).heights()));
  }
}

/// Every prefix decodes as the decoder does that was written from the text alone.
TEST(RelativeHeights, PrefixesAreThoseOfTheReferenceDecoder) {
  const Raster whole = make({Pattern::kRidges, 33, 29, 1, TKS_U16, 3});
  for (const OffsetKind kind : samples::kOffsetKinds) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withOffsets(whole, kind);
    const Bytes stream = encode(&heights, nullptr, lossless());
    const auto header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (size_t n = header; n <= stream.size(); n += 1 + (stream.size() - n) / 60) {
      const Bytes cut(stream.begin(), stream.begin() + static_cast<ptrdiff_t>(n));
      const reference::Decoded expected = reference::decode(cut);
      const std::vector<std::byte> got = Stream(cut).heights();
      ASSERT_TRUE(expected.heights && got.size() == expected.heights->size());
      ASSERT_EQ(std::memcmp(got.data(), expected.heights->data(), got.size()), 0) << n;
    }
  }
}

/// Exact heights serve other targets.
TEST(RelativeHeights, NoTargetTakesMoreBytesThanTheLastBit) {
  for (const OffsetKind kind : samples::kOffsetKinds) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withOffsets(steps(), kind);
    const size_t most = encode(&heights, nullptr, lossless()).size() + 64;
    const Bytes exact = encode(&heights, nullptr, budget(2 * most));
    EXPECT_TRUE(Stream(exact).heights() == heights.data);
    EXPECT_LE(exact.size(), most + most / 20);
    tks_encode_options psnr = budget(0), bound = budget(0);
    psnr.psnr = 150;
    bound.max_error = 1e-4;
    EXPECT_LE(encode(&heights, nullptr, psnr).size(), most);
    EXPECT_LE(encode(&heights, nullptr, bound).size(), most);
  }
}

/// Regions have models and heads of their own, and are cut where one track would be.
TEST(RelativeHeights, RegionsTakeLittleMore) {
  const Raster heights = samples::withOffsets(steps(), OffsetKind::kGeoid);
  const size_t one = encode(&heights, nullptr, lossless()).size();
  EXPECT_LT(encode(&heights, nullptr, inRegions(lossless(), 64)).size(), one + one / 5);
}

TEST(RelativeHeights, InRegionsWindowsAreThoseOfTheWhole) {
  for (const OffsetKind kind : samples::kOffsetKinds) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withOffsets(steps(), kind);
    const Bytes stream = encode(&heights, nullptr, inRegions(lossless(), 32));
    Stream opened(stream);
    EXPECT_TRUE(opened.heights() == heights.data);
    expectHeightsWindow(opened, {37, 51, 40, 40}, heights.data);
  }
}

}  // namespace
}  // namespace tetrakis::test
