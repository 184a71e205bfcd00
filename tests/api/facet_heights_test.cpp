// SPDX-License-Identifier: Apache-2.0
// Whole streams of floats that are linear between points.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/facets.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::Raster;

constexpr uint32_t kWidth = 150, kHeight = 140;

Bytes firstOf(const Bytes& stream, size_t bytes) {
  return {stream.begin(), stream.begin() + static_cast<ptrdiff_t>(bytes)};
}

/// Few samples lie beside edges, and only these have all digits of a float.
TEST(FacetHeights, TakeFewBitsASample) {
  for (const double spacing : {9.3, 20.7, 60.1}) {
    const Raster heights = samples::facets(kWidth, kHeight, spacing);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_EQ(Stream(stream).info().lossless, 1);
    EXPECT_EQ(readHeader(stream)->header.layers.corrections, CorrectionKind::kFacets);
    const double bits = 8. * static_cast<double>(stream.size()) / (kWidth * kHeight);
    EXPECT_LT(bits, 0.5 + 20 / spacing) << spacing;
  }
}

/// The floats of these facets times `relief`, above an elevation, right of a column.
Raster raised(double elevation, double relief, uint32_t from_column = 0) {
  Raster raster = samples::facets(kWidth, kHeight, 20.7);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const uint32_t x = i % kWidth;
    const double facet = samples::facetAt(x, i / kWidth, 20.7, 91);
    const auto sample = static_cast<float>(elevation * (x >= from_column) + relief * facet);
    std::memcpy(raster.data.data() + size_t{4} * i, &sample, sizeof sample);
  }
  return raster;
}

/// Of few metres far above the sea, floats are multiples of a step of 20 bits or fewer.
TEST(FacetHeights, ElevationDoesNotMatter) {
  const Raster low = raised(0, 0.08);
  const size_t bytes = encode(&low, nullptr, lossless()).size();
  for (const double elevation : {450.0, 4000.0}) {
    const Raster heights = raised(elevation, 0.08);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_LT(stream.size(), bytes + bytes / 4) << elevation;
  }
}

/// The steps of lossy heights show the plateau and nothing beside it.
TEST(FacetHeights, BudgetsWithRoomEndExact) {
  for (const Raster& heights :
       {raised(0, 1), raised(450, 0.08), raised(100, 1e-8, 70), raised(100, 1e-12, 70)}) {
    const size_t least = encode(&heights, nullptr, lossless()).size();
    for (const size_t bytes : {least + least / 8, 2 * least, 100 * least}) {
      const Bytes stream = encode(&heights, nullptr, budget(bytes));
      EXPECT_LE(stream.size(), bytes);
      EXPECT_TRUE(Stream(stream).heights() == heights.data) << bytes << " for " << least;
    }
  }
}

TEST(FacetHeights, OneRowOrColumnIsOfLines) {
  for (const bool across : {true, false}) {
    const Raster heights = samples::facets(across ? 2000 : 1, across ? 1 : 2000, 50.3);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_LT(stream.size(), 2000u * 4 / 6) << across;
  }
}

/// Prefixes up to the cut are those of lossy heights, and behind it rows become exact.
TEST(FacetHeights, PrefixesComeNearer) {
  const Raster heights = samples::facets(kWidth, kHeight, 12.7);
  const Bytes stream = encode(&heights, nullptr, lossless());
  double before = 1e9;
  for (size_t sixteenths = 1; sixteenths <= 16; ++sixteenths) {
    const Bytes cut = firstOf(stream, stream.size() * sixteenths / 16);
    const double rmse = rmseOf(heights, Stream(cut).heights());
    EXPECT_LE(rmse, before * 1.02) << sixteenths;
    before = rmse;
  }
  EXPECT_EQ(before, 0);
  const Bytes tenth = firstOf(stream, stream.size() / 10);
  const Bytes lossy = encode(&heights, nullptr, budget(tenth.size()));
  EXPECT_LT(rmseOf(heights, Stream(tenth).heights()),
            1.1 * rmseOf(heights, Stream(lossy).heights()));
}

/// Every prefix decodes as the decoder does that was written from the text alone.
TEST(FacetHeights, PrefixesAreThoseOfTheReferenceDecoder) {
  const Raster heights = samples::facets(43, 39, 7.9);
  for (const uint32_t region : {0u, 16u}) {
    tks_encode_options options = lossless();
    if (region > 0) options = inRegions(options, region);
    const Bytes stream = encode(&heights, nullptr, options);
    const auto header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (size_t n = header; n <= stream.size(); n += 1 + (stream.size() - n) / 60) {
      const Bytes cut = firstOf(stream, n);
      const reference::Decoded expected = reference::decode(cut);
      const std::vector<std::byte> got = Stream(cut).heights();
      ASSERT_TRUE(expected.heights && got.size() == expected.heights->size());
      ASSERT_EQ(std::memcmp(got.data(), expected.heights->data(), got.size()), 0) << n;
    }
  }
}

/// Exact heights serve other targets.
TEST(FacetHeights, NoTargetTakesMoreBytesThanTheLastBit) {
  const Raster heights = samples::facets(kWidth, kHeight, 20.7);
  const size_t least = encode(&heights, nullptr, lossless()).size();
  const Bytes exact = encode(&heights, nullptr, budget(3 * least));
  EXPECT_TRUE(Stream(exact).heights() == heights.data);
  EXPECT_LE(exact.size(), least + least / 2) << "room for a finer cut";
  tks_encode_options psnr = budget(0), bound = budget(0);
  psnr.psnr = 170;
  bound.max_error = 1e-6;
  EXPECT_LE(encode(&heights, nullptr, psnr).size(), least + 64);
  EXPECT_LE(encode(&heights, nullptr, bound).size(), least + 64);
}

/// A budget that holds them all does not make prefixes worse.
TEST(FacetHeights, PrefixesOfBudgetsStay) {
  const Raster heights = samples::facets(kWidth, kHeight, 20.7);
  const size_t least = encode(&heights, nullptr, lossless()).size();
  const Bytes some = encode(&heights, nullptr, budget(least / 2));
  const Bytes all = encode(&heights, nullptr, budget(2 * least));
  for (const size_t part : {8u, 4u}) {
    const double of_some = rmseOf(heights, Stream(firstOf(some, least / part)).heights());
    EXPECT_LT(rmseOf(heights, Stream(firstOf(all, least / part)).heights()), 1.5 * of_some);
  }
}

TEST(FacetHeights, InRegionsWindowsAreThoseOfTheWhole) {
  const Raster heights = samples::facets(kWidth, kHeight, 20.7);
  const Bytes stream = encode(&heights, nullptr, inRegions(lossless(), 32));
  Stream opened(stream);
  EXPECT_TRUE(opened.heights() == heights.data);
  EXPECT_LT(stream.size(), 3 * encode(&heights, nullptr, lossless()).size());
  expectHeightsWindow(opened, {37, 51, 40, 40}, heights.data);
}

}  // namespace
}  // namespace tetrakis::test
