// SPDX-License-Identifier: Apache-2.0
// Forests in regions: every sample comes back, windows and their levels hold what the whole holds
// there, and take no tracks but those that reach them.
#include <algorithm>
#include <random>

#include "base/forest.hpp"
#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;

ForestRaster rasterOn(const ForestShape& shape, int depth, tks_sample sample = TKS_I16) {
  return {Forest(depth, shape.sides), {Pattern::kRidges, 0, 0, 1, sample, 3}};
}

ForestRaster texelsOn(const ForestShape& shape, int depth) {
  return {Forest(depth, shape.sides), {Pattern::kRidges, 0, 0, 3, TKS_U8, 8}};
}

size_t tracksOf(const Bytes& bytes) {
  const Result<ParsedHeader> parsed = readHeader(bytes);
  return parsed.ok() ? trackCounts(parsed->header).all() : 0;
}

TEST(ForestRegions, RestoreEverySampleOfEveryShape) {
  for (const ForestShape& shape : forestShapes()) {
    for (const int depth : {4, 5, 6, 7}) {
      const ForestRaster surface = rasterOn(shape, depth);
      const Bytes bytes = encodeHeights(surface.heights(), inRegions(lossless()));
      const size_t along = size_t{1} << (depth - 4);
      size_t tracks = 1;
      for (size_t side = along; side > 1; side >>= 3) tracks += shape.patches() * side * side;
      ASSERT_EQ(tracksOf(bytes), tracks) << shape.name << ", depth " << depth;
      Stream stream(bytes);
      ASSERT_EQ(stream.heights(), surface.raster.data) << shape.name << ", depth " << depth;
    }
  }
}

/// A patch of few samples is one region, and needs no other track than the base.
TEST(ForestRegions, LeaveSmallPatchesInOneTrack) {
  const ForestRaster surface = rasterOn(cubeShape(), 4);
  EXPECT_EQ(encodeHeights(surface.heights(), inRegions(lossless())),
            encodeHeights(surface.heights(), lossless()));
}

TEST(ForestRegions, DecodeWindowsOfEveryPrefix) {
  for (const ForestShape& shape : forestShapes()) {
    SCOPED_TRACE(shape.name);
    for (const int depth : {2, 5, 6}) {
      for (const auto& options : {lossless(), budget(3000), within(9)}) {
        const ForestRaster surface = rasterOn(shape, depth);
        expectWindows(encodeHeights(surface.heights(), inRegions(options)));
        expectWindows(encodeHeights(surface.heights(), options));
        if (HasFatalFailure()) return;
      }
      expectWindows(texelsOn(shape, depth).encodedTexels(inRegions(budget(6000))));
      expectWindows(rasterOn(shape, depth, TKS_F32).encoded(inRegions(lossless())));
      if (HasFatalFailure()) return;
    }
  }
}

/// Points and small windows see what lies across sides at all distances from them.
TEST(ForestRegions, DecodeSmallWindowsOfAllLevels) {
  std::mt19937 random(7);
  const auto below = [&](uint32_t count) { return static_cast<uint32_t>(random() % count); };
  for (const ForestShape& shape : forestShapes()) {
    const ForestRaster surface = rasterOn(shape, 6);
    const Stream stream(encodeHeights(surface.heights(), inRegions(budget(5000))));
    for (uint32_t level = 0; level < 6; ++level) {
      ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
      const uint32_t side = (64u >> level) + 1, height = side * shape.patches();
      std::vector<std::byte> whole(size_t{2} * side * height);
      ASSERT_EQ(tks_decode_heights(stream.get(), whole.data(), whole.size()), TKS_OK);
      for (int trial = 0; trial < 60; ++trial) {
        const uint32_t x = below(side), y = below(height);
        const tks_window w{x, y, 1 + below(std::min(side - x, 4u)),
                           1 + below(std::min(height - y, 4u))};
        expectWindow(stream, tks_decode_heights_window, w, cropBytes(whole, 2 * side, 2, w));
        ASSERT_FALSE(HasFatalFailure()) << shape.name << ", level " << level;
      }
    }
  }
}

tks_encode_options indexed(tks_encode_options options) {
  options.index = TKS_INDEX_PACKETS;
  return inRegions(options);
}

/// The ranges that a window needs make it what the whole stream makes it, and are few.
TEST(ForestRegions, FetchNoMoreThanAWindowNeeds) {
  const ForestRaster surface = rasterOn(cubeShape(), 8);
  const Bytes bytes = encodeHeights(surface.heights(), indexed(lossless()));
  const std::vector<std::byte> whole = Stream(bytes).heights();
  for (const tks_window& w :
       {tks_window{100, 3 * 257 + 120, 20, 20}, {0, 257 + 3, 9, 9}, {250, 5 * 257 + 250, 7, 7}}) {
    const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    Stream stream(Prefix(bytes).first(header));
    tks_ranges ranges{};
    ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &w, &ranges), TKS_OK);
    std::vector<const uint8_t*> data;
    uint64_t fetched = 0;
    for (size_t i = 0; i < ranges.count; ++i) {
      data.push_back(bytes.data() + ranges.ranges[i].offset);
      fetched += ranges.ranges[i].size;
    }
    EXPECT_LT(fetched, bytes.size() / 2);
    ASSERT_EQ(tks_put_ranges(stream.get(), ranges.ranges, data.data(), ranges.count), TKS_OK);
    tks_free_ranges(&ranges);
    expectHeightsWindow(stream, w, whole);
  }
}

/// A limit that suffices for a window suffices for the same window of a cube of any size.
TEST(ForestRegions, DecodeWindowsWhereTheWholeDoesNotFit) {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = 6 << 20;
  for (const int depth : {9, 10}) {
    const ForestRaster surface = rasterOn(cubeShape(), depth);
    const Bytes bytes = encodeHeights(surface.heights(), inRegions(budget(20000), 64));
    const std::vector<std::byte> whole = Stream(bytes).heights();
    const Stream stream(bytes, &limits);
    EXPECT_EQ(tks_check_memory(stream.get(), TKS_PART_HEIGHTS, nullptr, 0, 0, nullptr), TKS_LIMIT);
    const uint32_t side = surface.forest.side();
    for (const tks_window& w :
         {tks_window{60, side + 70, 50, 50}, {side - 20, 3 * side - 60, 20, 60}})
      expectHeightsWindow(stream, w, whole);
  }
}

TEST(ForestRegions, AgreeWithTheReferenceDecoder) {
  for (const ForestShape& shape : forestShapes()) {
    const ForestRaster surface = rasterOn(shape, 5);
    for (const auto& options : {lossless(), budget(900), within(9)}) {
      const Bytes bytes = encodeHeights(surface.heights(), inRegions(options));
      for (size_t cut = bytes.size(); cut > 0; cut = cut * 3 / 4) {
        const Prefix prefix = Prefix(bytes).first(cut);
        const reference::Decoded expected = reference::decode(prefix, reference::kMaxSamples);
        Stream stream(prefix);
        if (stream.status() != TKS_OK) continue;
        Bytes heights(surface.raster.data.size());
        ASSERT_EQ(tks_decode_heights(stream.get(), heights.data(), heights.size()), TKS_OK);
        ASSERT_EQ(heights, expected.heights) << shape.name << ", " << cut << " bytes";
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
