// SPDX-License-Identifier: Apache-2.0
// Streams of heights and textures whose columns go round: what comes back, whole and in windows.
#include <cmath>
#include <numbers>

#include "conformance/reference_decoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// Waves of whole periods round the ring, with some roughness.
Raster globe(uint32_t width, uint32_t height) {
  Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double angle = 2 * std::numbers::pi * x / width;
      const double wave = 900 * std::sin(3 * angle + 0.1 * y) + 700 * std::cos(7 * angle);
      const auto rough = static_cast<double>(samples::hash(x, y, 5) % 64);
      const auto value = static_cast<int16_t>(std::lround(wave + rough));
      std::memcpy(raster.data.data() + 2 * (size_t{y} * width + x), &value, sizeof value);
    }
  }
  return raster;
}

tks_heights goingRound(const Raster& raster) {
  tks_heights heights = raster.heights();
  heights.domain = TKS_DOMAIN_CYLINDER;
  return heights;
}

tks_image goingRound(tks_image image) {
  image.domain = TKS_DOMAIN_CYLINDER;
  return image;
}

TEST(RingStream, RestoresEverySampleOfEveryWidth) {
  for (uint32_t width = 1; width <= 40; ++width) {
    const Raster raster = globe(width, 21);
    const Bytes bytes = encodeHeights(goingRound(raster), lossless());
    Stream stream(bytes);
    ASSERT_EQ(stream.info().domain, TKS_DOMAIN_CYLINDER);
    ASSERT_EQ(stream.heights(), raster.data) << width;
  }
}

TEST(RingStream, SaysNothingOfThePlane) {
  const Raster raster = globe(40, 21);
  const Bytes bytes = encodeHeights(raster.heights(), lossless());
  EXPECT_EQ(Stream(bytes).info().domain, TKS_DOMAIN_PLANE);
}

TEST(RingStream, KeepsTheErrorThatItPromises) {
  const Raster raster = globe(150, 97);
  const Bytes bytes = encodeHeights(goingRound(raster), within(7));
  Stream stream(bytes);
  EXPECT_LE(largestError(raster, stream.heights()), 7);
}

TEST(RingStream, LeavesAJumpAtTheSeamThatIsNoLargerThanElsewhere) {
  const Raster raster = globe(256, 128);
  const auto error_at_seam = [&](const tks_heights& heights) {
    const Bytes bytes = encodeHeights(heights, budget(1200));
    const std::vector<std::byte> decoded = Stream(bytes).heights();
    double sum = 0;
    for (size_t y = 0; y < 128; ++y) {
      const auto error = [&](size_t x) {
        return sampleAt(decoded, TKS_I16, y * 256 + x) -
               sampleAt(raster.data, TKS_I16, y * 256 + x);
      };
      sum += std::abs(error(255) - error(0));
    }
    return sum / 128;
  };
  EXPECT_LT(error_at_seam(goingRound(raster)), 0.8 * error_at_seam(raster.heights()));
}

/// In the middle, at either side, across nearly all columns, and of one sample; and across the
/// seam: of two columns, a turn, and from the last column on.
std::vector<tks_window> windowsOf(uint32_t columns) {
  return {{0, 0, 5, 97},
          {120, 3, 11, 7},
          {60, 60, 40, 30},
          {75, 40, 1, 1},
          {1, 0, 129, 2},
          {0, 0, 131, 97},
          {columns - 1, 0, 2, 97},
          {70, 30, columns, 9},
          {columns - 1, 90, columns, 7},
          {columns - 9, 0, 40, 5},
          {columns - 30, 60, 60, 37}};
}

/// The rows of a window of `all`, of so many columns, are those of the plane, round and round.
void expectCut(const tks_window& window, uint32_t columns, size_t bytes,
               const std::vector<std::byte>& all, const std::vector<std::byte>& out) {
  for (size_t y = 0; y < window.height; ++y) {
    for (size_t x = 0; x < window.width; ++x) {
      const size_t column = (window.x + x) % columns;
      const std::byte* const place = all.data() + bytes * ((window.y + y) * columns + column);
      const std::byte* const cut = out.data() + bytes * (y * window.width + x);
      ASSERT_TRUE(std::equal(place, place + bytes, cut)) << window.x << ", " << window.y;
    }
  }
}

void expectWindows(const tks_heights& heights, const tks_encode_options& options) {
  const Bytes bytes = encodeHeights(heights, options);
  Stream stream(bytes);
  const std::vector<std::byte> all = stream.heights();
  const size_t size = tks_sample_bytes(heights.sample);
  for (const tks_window& window : windowsOf(heights.width)) {
    std::vector<std::byte> out(size * window.width * window.height);
    ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, out.data(), out.size()), TKS_OK);
    expectCut(window, heights.width, size, all, out);
  }
}

TEST(RingStream, GivesWindowsTheSamplesOfThePlane) {
  tks_encode_options for_windows = inRegions(lossless(), 32);
  for_windows.index = TKS_INDEX_WINDOWS;
  for (const uint32_t width : {131u, 160u, 230u}) {
    for (const Raster& raster : {globe(width, 97), make({Pattern::kHills, width, 97, 1, TKS_U16}),
                                 make({Pattern::kSteps, width, 97, 1, TKS_U8, 4})}) {
      for (const tks_encode_options& options :
           {budget(2000), inRegions(budget(3000)), for_windows, inRegions(within(2))})
        expectWindows(goingRound(raster), options);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(RingStream, GivesWindowsBesideVoidsTheSamplesOfThePlane) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    Raster raster = globe(131, 97);
    const auto valid = samples::validity(shape, 131, 97);
    for (size_t i = 0; i < valid.size(); ++i) {
      const int16_t nodata = -32768;
      if (!valid[i]) std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
    }
    tks_heights heights = goingRound(raster);
    heights.has_nodata = 1;
    heights.nodata = -32768;
    for (const tks_encode_options& options : {budget(3000), inRegions(lossless())})
      expectWindows(heights, options);
    if (HasFatalFailure()) return;
  }
}

TEST(RingStream, GivesWindowsTheTexelsOfThePlane) {
  const Raster raster = make({Pattern::kRidges, 131, 97, 3, TKS_U8, 4});
  const tks_image image = goingRound(raster.image());
  for (const tks_encode_options& options : {budget(9000), inRegions(lossless())}) {
    const Bytes bytes = encodeGiven(nullptr, &image, options);
    Stream stream(bytes);
    EXPECT_EQ(stream.info().texture_domain, TKS_DOMAIN_CYLINDER);
    const std::vector<std::byte> all = stream.texture();
    for (const tks_window& window : windowsOf(131)) {
      std::vector<std::byte> out(size_t{3} * window.width * window.height);
      ASSERT_EQ(tks_decode_texture_window(stream.get(), &window, out.data(), out.size()), TKS_OK);
      expectCut(window, 131, 3, all, out);
    }
  }
}

TEST(RingStream, RefusesWindowsThatBeginOutsideOrGoRoundTwice) {
  const Raster raster = globe(40, 21);
  const Bytes round = encodeHeights(goingRound(raster), budget(900)),
              plane = encodeHeights(raster.heights(), budget(900));
  const auto status = [](const Bytes& bytes, const tks_window& window) {
    Stream stream(bytes);
    std::vector<std::byte> out(2 * size_t{window.width} * window.height);
    return tks_decode_heights_window(stream.get(), &window, out.data(), out.size());
  };
  EXPECT_EQ(status(round, {39, 0, 2, 1}), TKS_OK);
  EXPECT_EQ(status(plane, {39, 0, 2, 1}), TKS_USAGE);
  for (const tks_window& window : {tks_window{40, 0, 1, 1}, tks_window{0, 0, 41, 1},
                                   tks_window{39, 20, 2, 2}, tks_window{39, 21, 2, 1}})
    EXPECT_EQ(status(round, window), TKS_USAGE) << window.x << ", " << window.y;
}

/// Read by ranges, such a window is that of the whole stream.
TEST(RingStream, KnowsTheRangesOfWindowsAcrossTheSeam) {
  tks_encode_options options = inRegions(lossless(), 32);
  options.index = TKS_INDEX_WINDOWS;
  const Raster raster = globe(230, 97);
  const Bytes bytes = encodeHeights(goingRound(raster), options);
  const tks_window window{220, 40, 20, 20};
  const auto header = static_cast<ptrdiff_t>(Stream(bytes).info().header_bytes);
  Stream part(Bytes(bytes.begin(), bytes.begin() + header));
  tks_ranges ranges{};
  ASSERT_EQ(tks_needed_ranges(part.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
  uint64_t sum = 0;
  for (size_t i = 0; i < ranges.count; ++i) {
    const tks_range& range = ranges.ranges[i];
    sum += range.size;
    ASSERT_EQ(tks_put(part.get(), range.offset, bytes.data() + range.offset, range.size), TKS_OK);
  }
  tks_free_ranges(&ranges);
  EXPECT_LT(sum, bytes.size() - 1000);
  std::vector<std::byte> out(2 * size_t{20} * 20);
  ASSERT_EQ(tks_decode_heights_window(part.get(), &window, out.data(), out.size()), TKS_OK);
  expectCut(window, 230, 2, raster.data, out);
}

TEST(RingStream, RestoresTexturesOfAllKinds) {
  for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
    for (const uint32_t channels : {1u, 3u, 4u}) {
      const Raster raster = make({pattern, 61, 30, channels, TKS_U8, 2});
      const tks_image image = goingRound(raster.image());
      const Bytes bytes = encodeGiven(nullptr, &image, lossless());
      Stream stream(bytes);
      EXPECT_EQ(stream.info().texture_domain, TKS_DOMAIN_CYLINDER);
      EXPECT_EQ(stream.texture(), raster.data) << channels;
    }
  }
}

/// The header then has two domains.
TEST(RingStream, MayHaveATextureOnThePlane) {
  const Raster raster = globe(40, 21), texels = make({Pattern::kRidges, 40, 21, 3, TKS_U8, 2});
  const tks_heights heights = goingRound(raster);
  for (const tks_image& image : {texels.image(), goingRound(texels.image())}) {
    const Bytes bytes = encodeGiven(&heights, &image, lossless());
    Stream stream(bytes);
    EXPECT_EQ(stream.info().domain, TKS_DOMAIN_CYLINDER);
    EXPECT_EQ(stream.info().texture_domain, image.domain);
    EXPECT_EQ(stream.heights(), raster.data);
    EXPECT_EQ(stream.texture(), texels.data);
  }
}

TEST(RingStream, TakesNoDomainThatIsUnknown) {
  const Raster raster = globe(40, 21);
  tks_heights heights = raster.heights();
  heights.domain = static_cast<tks_domain>(2);
  const tks_encode_options options = lossless();
  tks_buffer buffer = {};
  EXPECT_EQ(tks_encode(&heights, nullptr, &options, &buffer, nullptr, 0), TKS_USAGE);
}

TEST(RingStream, HasTheMipLevelsOfTheReferenceDecoder) {
  const Raster raster = globe(75, 40);
  for (const tks_encode_options& options : {lossless(), budget(900)}) {
    const Bytes bytes = encodeHeights(goingRound(raster), options);
    Stream stream(bytes);
    for (uint32_t level = 0; level <= stream.info().coarsest_level; ++level) {
      ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
      tks_info info{};
      info.size = sizeof info;
      tks_get_info(stream.get(), &info);
      Bytes out(size_t{2} * info.width * info.height);
      ASSERT_EQ(tks_decode_heights(stream.get(), out.data(), out.size()), TKS_OK);
      const int k = static_cast<int>(level);
      EXPECT_EQ(reference::decode(bytes, reference::kMaxSamples, {k, 0}).heights, out) << level;
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
