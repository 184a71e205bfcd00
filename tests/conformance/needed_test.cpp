// SPDX-License-Identifier: Apache-2.0
// What tks_needed_ranges names is enough: a decoder that is given the header and those bytes
// decodes what one decodes that has all of the stream.
#include <limits>
#include <random>

#include "tests/support/indexed_terrain.hpp"
#include "tests/support/later_stream.hpp"

namespace tetrakis::test {
namespace {

tks_encode_options forWindows() {
  tks_encode_options options = lossless();
  options.index = TKS_INDEX_WINDOWS;
  return options;
}

samples::Raster ridges(uint32_t width, uint32_t height, tks_sample sample) {
  return samples::make({samples::Pattern::kRidges, width, height, 1, sample});
}

/// Heights, or texels, of a window, or of the level that is set.
std::vector<std::byte> decoded(Stream& stream, tks_part part, const tks_window* window) {
  tks_info info = {};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
  const bool heights = part == TKS_PART_HEIGHTS;
  const size_t places = window    ? size_t{window->width} * window->height
                        : heights ? size_t{info.width} * info.height
                                  : size_t{info.texture_width} * info.texture_height;
  const size_t pixel = heights ? tks_sample_bytes(info.sample)
                               : info.texture_channels * tks_sample_bytes(info.texture_sample);
  std::vector<std::byte> out(places * pixel);
  tks_decoder* const d = stream.get();
  const tks_status status =
      heights  ? window ? tks_decode_heights_window(d, window, out.data(), out.size())
                        : tks_decode_heights(d, out.data(), out.size())
       : window ? tks_decode_texture_window(d, window, out.data(), out.size())
               : tks_decode_texture(d, out.data(), out.size());
  EXPECT_EQ(status, TKS_OK) << tks_message(d);
  return out;
}

/// Decodes from nothing but what is needed; returns how many bytes that were.
uint64_t expectEnough(const Bytes& bytes, tks_part part, const tks_window* window,
                      uint32_t level = 0) {
  Stream whole(bytes);
  const size_t header = whole.info().header_bytes;
  Stream stream(Prefix(bytes).first(header));
  for (Stream* one : {&whole, &stream}) {
    EXPECT_EQ(tks_set_levels(one->get(), part == TKS_PART_HEIGHTS ? level : 0,
                             part == TKS_PART_TEXTURE ? level : 0),
              TKS_OK);
  }
  tks_ranges ranges = {};
  EXPECT_EQ(tks_needed_ranges(stream.get(), part, window, &ranges), TKS_OK)
      << tks_message(stream.get());
  uint64_t sum = 0, end = header;
  std::vector<tks_range> order(ranges.ranges, ranges.ranges + ranges.count);
  tks_free_ranges(&ranges);
  for (const tks_range& range : order) {
    const bool touches = range.offset == end && whole.info().index == TKS_INDEX_WINDOWS;
    EXPECT_TRUE(sum == 0 || range.offset > end || touches);
    EXPECT_GE(range.offset, header);
    EXPECT_GT(range.size, 0u);
    EXPECT_LE(range.offset + range.size, bytes.size());
    end = range.offset + range.size;
    sum += range.size;
  }
  std::reverse(order.begin(), order.end());
  for (const tks_range& range : order)
    EXPECT_EQ(tks_put(stream.get(), range.offset, bytes.data() + range.offset, range.size), TKS_OK)
        << tks_message(stream.get());
  EXPECT_TRUE(decoded(stream, part, window) == decoded(whole, part, window))
      << "part " << part << ", level " << level;
  return sum;
}

void expectWindows(const Bytes& bytes, tks_part part, uint32_t width, uint32_t height) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 6; ++trial) {
    const uint32_t w = 1 + static_cast<uint32_t>(random() % std::min(width, 40u));
    const uint32_t h = 1 + static_cast<uint32_t>(random() % std::min(height, 40u));
    const tks_window window{static_cast<uint32_t>(random() % (width - w + 1)),
                            static_cast<uint32_t>(random() % (height - h + 1)), w, h};
    expectEnough(bytes, part, &window);
  }
  const tks_window corner{width - 1, 0, 1, 1}, all{0, 0, width, height};
  EXPECT_LT(expectEnough(bytes, part, &corner), expectEnough(bytes, part, &all));
}

TEST(NeededRanges, OfWindowsAreEnoughHoweverTheStreamIsCoded) {
  const samples::Raster heights = ridges(201, 170, TKS_I16), floats = ridges(150, 131, TKS_F32),
                        image = samples::make({samples::Pattern::kRidges, 180, 150, 3, TKS_U8});
  for (const tks_encode_options& options : {lossless(), budget(9000), forWindows()}) {
    const Bytes both = encodeRegions(&heights, &image, options);
    expectWindows(both, TKS_PART_HEIGHTS, 201, 170);
    expectWindows(both, TKS_PART_TEXTURE, 180, 150);
    expectWindows(encodeRegions(&floats, nullptr, options), TKS_PART_HEIGHTS, 150, 131);
  }
}

/// Bytes of the front, or of windows before, may close the gaps between what a window needs.
TEST(NeededRanges, AreEnoughBesideWhateverIsThere) {
  const samples::Raster heights = ridges(201, 170, TKS_I16);
  const Bytes bytes = encodeRegions(&heights, nullptr, forWindows());
  Stream whole(bytes);
  const size_t header = whole.info().header_bytes;
  const tks_window windows[] = {
      {0, 0, 40, 40}, {161, 0, 40, 40}, {80, 70, 30, 30}, {0, 130, 40, 40}};
  for (size_t front = header; front < bytes.size(); front += 1 + (bytes.size() - header) / 40) {
    Stream stream(Prefix(bytes).first(front));
    for (const tks_window& window : windows) {
      tks_ranges ranges = {};
      ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
      for (size_t i = 0; i < ranges.count; ++i) {
        const auto [offset, size, gain] = ranges.ranges[i];
        ASSERT_EQ(tks_put(stream.get(), offset, bytes.data() + offset, size), TKS_OK);
      }
      tks_free_ranges(&ranges);
      ASSERT_TRUE(decoded(stream, TKS_PART_HEIGHTS, &window) ==
                  decoded(whole, TKS_PART_HEIGHTS, &window))
          << front << " bytes, window from " << window.x << ", " << window.y;
    }
  }
}

/// Packets of components that nobody knows yet are never needed.
TEST(NeededRanges, LeaveOutWhatNobodyKnows) {
  const samples::Raster heights = ridges(201, 170, TKS_I16),
                        image = samples::make({samples::Pattern::kRidges, 180, 150, 3, TKS_U8});
  const Bytes plain = encodeRegions(&heights, &image, lossless());
  const Domain sphere{9, {0, 0}};
  const Bytes bytes =
      LaterStream(plain, {unknown(5, sphere, 3, ""), known(Component::kTexture),
                          unknown(6, sphere, 0, "later"), known(Component::kGeometry)})
          .make()
          .later;
  EXPECT_EQ(Stream(bytes).info().index, Stream(plain).info().index);
  expectWindows(bytes, TKS_PART_HEIGHTS, 201, 170);
  expectWindows(bytes, TKS_PART_TEXTURE, 180, 150);
  // The numbers of four components may make a head a byte longer than those of two.
  const uint64_t heads = Stream(plain).info().packets;
  for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE})
    EXPECT_LE(expectEnough(bytes, part, nullptr), expectEnough(plain, part, nullptr) + heads);
}

TEST(NeededRanges, LieTogetherWhereTheIndexIsForWindows) {
  const samples::Raster heights = ridges(401, 370, TKS_I16);
  const tks_window window{170, 160, 60, 50};
  struct Needed {
    size_t pieces = 0;
    uint64_t bytes = 0;
  };
  const auto needed = [&](const Bytes& bytes) {
    Stream stream(bytes);
    tks_ranges ranges = {};
    EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
    Needed sum;
    uint64_t end = 0;
    for (size_t i = 0; i < ranges.count; ++i) {
      sum.pieces += ranges.ranges[i].offset > end;
      sum.bytes += ranges.ranges[i].size;
      end = ranges.ranges[i].offset + ranges.ranges[i].size;
    }
    tks_free_ranges(&ranges);
    return sum;
  };
  const Bytes together = encodeRegions(&heights, nullptr, forWindows());
  const Bytes strewn = encodeRegions(&heights, nullptr, lossless());
  const Needed few = needed(together), many = needed(strewn);
  EXPECT_LT(4 * few.pieces, many.pieces);
  EXPECT_LT(4 * few.bytes, 3 * many.bytes) << "filters of coarse levels reach less";
  EXPECT_LT(100 * together.size(), 101 * strewn.size());
  Stream stream(together);
  EXPECT_EQ(stream.info().lossless, 1);
  EXPECT_EQ(stream.info().index, TKS_INDEX_WINDOWS);
  EXPECT_EQ(Stream(strewn).info().index, TKS_INDEX_PACKETS);
  EXPECT_EQ(Stream(encode(&heights, nullptr, lossless())).info().index, TKS_INDEX_NONE);
  tks_encode_options by_default = forWindows();
  by_default.regions = 0;
  const samples::Raster larger = ridges(600, 530, TKS_I16);
  EXPECT_EQ(Stream(encode(&larger, nullptr, by_default)).info().regions, 256u);
  tks_encode_options cut = budget(9000);
  cut.index = TKS_INDEX_WINDOWS;
  tks_buffer none = {};
  const tks_heights source = heights.heights();
  EXPECT_EQ(tks_encode(&source, nullptr, &cut, &none, nullptr, 0), TKS_USAGE);
  tks_encode_options one_region = forWindows();
  one_region.regions = 1;
  EXPECT_EQ(tks_encode(&source, nullptr, &one_region, &none, nullptr, 0), TKS_USAGE);
}

/// Heights within a largest error are whole, too; beside them a texture would be cut.
TEST(NeededRanges, OfBoundedHeightsFollowTheWindow) {
  const samples::Raster heights = ridges(200, 150, TKS_U16),
                        image = samples::make({samples::Pattern::kRidges, 40, 30, 3, TKS_U8});
  tks_encode_options options = forWindows();
  options.lossless = 0;
  options.max_error = 500;
  const Bytes bytes = encodeRegions(&heights, nullptr, options);
  EXPECT_EQ(Stream(bytes).info().index, TKS_INDEX_WINDOWS);
  expectWindows(bytes, TKS_PART_HEIGHTS, 200, 150);
  tks_buffer none = {};
  const tks_heights source = heights.heights();
  const tks_image texture = image.image();
  EXPECT_EQ(tks_encode(&source, &texture, &options, &none, nullptr, 0), TKS_USAGE);
}

TEST(NeededRanges, OfLevelsLeaveOutTheFinestRegions) {
  const samples::Raster heights = ridges(201, 170, TKS_I16),
                        image = samples::make({samples::Pattern::kRidges, 180, 150, 3, TKS_U8});
  const Bytes bytes = encodeRegions(&heights, &image, lossless());
  for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE}) {
    std::vector<uint64_t> sizes;
    for (uint32_t level = 0; level <= 6; ++level)
      sizes.push_back(expectEnough(bytes, part, nullptr, level));
    EXPECT_EQ(sizes[0], sizes[2]);
    EXPECT_LT(sizes[3], sizes[2] / 4);
    EXPECT_LE(sizes[6], sizes[3]);
  }
}

/// A decoder that has the front of a stream decodes a prefix; what is needed never looks like one.
TEST(NeededRanges, OfTheFrontAreNotTakenForAPrefix) {
  const samples::Raster heights = ridges(33, 16, TKS_I16);
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  for (uint32_t width = 1; width <= 33; ++width) {
    for (const uint32_t x : {0u, 33 - width}) {
      const tks_window window{x, 0, width, 16};
      expectEnough(bytes, TKS_PART_HEIGHTS, &window);
    }
  }
}

TEST(NeededRanges, BesideVoids) {
  samples::Raster raster = ridges(140, 90, TKS_F32);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < 140 * 90; ++i)
    if (i % 140 + i / 140 < 80) std::memcpy(raster.data.data() + 4 * i, &nan, sizeof nan);
  const Bytes bytes = encodeRegions(&raster, nullptr, lossless());
  expectWindows(bytes, TKS_PART_HEIGHTS, 140, 90);
  Stream whole(bytes), stream(Prefix(bytes).first(whole.info().header_bytes));
  tks_ranges ranges = {};
  ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_VALIDITY, nullptr, &ranges), TKS_OK);
  for (size_t i = 0; i < ranges.count; ++i) {
    const tks_range& range = ranges.ranges[i];
    ASSERT_EQ(tks_put(stream.get(), range.offset, bytes.data() + range.offset, range.size), TKS_OK);
  }
  tks_free_ranges(&ranges);
  std::vector<uint8_t> expected(140 * 90), valid(140 * 90);
  ASSERT_EQ(tks_decode_validity(whole.get(), expected.data(), expected.size()), TKS_OK);
  ASSERT_EQ(tks_decode_validity(stream.get(), valid.data(), valid.size()), TKS_OK);
  EXPECT_TRUE(valid == expected);
}

/// Corrections are decoded from the first row on: a window needs the rows before it as well.
/// Corrections of regions are tracks of their own: a window anywhere takes a part of the stream.
TEST(NeededRanges, OfStreamsWithCorrectionsFollowTheWindow) {
  constexpr uint32_t kWidth = 64, kHeight = 300;
  samples::Raster thirds = ridges(kWidth, kHeight, TKS_F32);
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    const auto third = static_cast<float>(sampleAt(thirds.data, TKS_F32, i) / 3);
    std::memcpy(thirds.data.data() + 4 * i, &third, 4);
  }
  for (const tks_encode_options& options : {lossless(), forWindows()}) {
    const Bytes bytes = encodeRegions(&thirds, nullptr, options);
    const uint64_t all = bytes.size() - Stream(bytes).info().header_bytes;
    const uint64_t some = options.index == TKS_INDEX_WINDOWS ? all / 2 : all * 4 / 5;
    for (uint32_t y = 0; y + 7 <= kHeight; y += 23) {
      const tks_window window{50, y, 5, 7};
      EXPECT_LT(expectEnough(bytes, TKS_PART_HEIGHTS, &window), some) << y;
    }
    expectWindows(bytes, TKS_PART_HEIGHTS, kWidth, kHeight);
    EXPECT_LT(expectEnough(bytes, TKS_PART_HEIGHTS, nullptr, 1), all) << "no corrections";
  }
}

TEST(NeededRanges, NonsenseIsRefused) {
  const samples::Raster heights = ridges(70, 60, TKS_I16);
  const Bytes plain = encode(&heights, nullptr, lossless());
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  Stream without(plain), stream(bytes);
  tks_ranges ranges = {1, nullptr};
  EXPECT_EQ(tks_needed_ranges(without.get(), TKS_PART_HEIGHTS, nullptr, &ranges), TKS_USAGE);
  EXPECT_NE(std::string(tks_message(without.get())).find("no index"), std::string::npos);
  EXPECT_EQ(ranges.count, 0u);
  EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_TEXTURE, nullptr, &ranges), TKS_USAGE);
  EXPECT_EQ(tks_needed_ranges(stream.get(), static_cast<tks_part>(7), nullptr, &ranges), TKS_USAGE);
  const tks_window outside{60, 0, 20, 1};
  EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &outside, &ranges), TKS_USAGE);
  EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, nullptr, nullptr), TKS_USAGE);
  EXPECT_EQ(tks_needed_ranges(nullptr, TKS_PART_HEIGHTS, nullptr, &ranges), TKS_USAGE);
  EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_BUDGET_MESH, nullptr, &ranges), TKS_OK);
  EXPECT_EQ(ranges.count, 1u) << "all of the payload";
  tks_free_ranges(&ranges);
  tks_free_ranges(&ranges);
  tks_free_ranges(nullptr);
}

}  // namespace
}  // namespace tetrakis::test
