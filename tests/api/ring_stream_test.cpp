// SPDX-License-Identifier: Apache-2.0
// Streams of heights whose columns go round: what comes back, and what is refused.
#include <cmath>
#include <numbers>

#include "conformance/reference_decoder.hpp"
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
  heights.columns_go_round = 1;
  return heights;
}

tks_status statusOf(const tks_heights& heights, const tks_image* image,
                    const tks_encode_options& options) {
  tks_buffer buffer = {};
  const tks_status status = tks_encode(&heights, image, &options, &buffer, nullptr, 0);
  tks_free_buffer(&buffer);
  return status;
}

TEST(RingStream, RestoresEverySampleOfEveryWidth) {
  for (uint32_t width = 1; width <= 40; ++width) {
    const Raster raster = globe(width, 21);
    const Bytes bytes = encodeHeights(goingRound(raster), lossless());
    Stream stream(bytes);
    ASSERT_EQ(stream.info().columns_go_round, 1);
    ASSERT_EQ(stream.heights(), raster.data) << width;
  }
}

TEST(RingStream, SaysNothingOfThePlane) {
  const Raster raster = globe(40, 21);
  const Bytes bytes = encodeHeights(raster.heights(), lossless());
  EXPECT_EQ(Stream(bytes).info().columns_go_round, 0);
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

TEST(RingStream, CutsWindowsOutOfThePlane) {
  const Raster raster = globe(150, 97);
  for (const tks_encode_options& options : {budget(2000), inRegions(lossless(), 32)}) {
    const Bytes bytes = encodeHeights(goingRound(raster), options);
    Stream stream(bytes);
    const std::vector<std::byte> all = stream.heights();
    for (const tks_window& window : {tks_window{0, 0, 5, 97}, {140, 3, 10, 7}, {60, 60, 40, 30}}) {
      std::vector<std::byte> out(size_t{2} * window.width * window.height);
      ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, out.data(), out.size()), TKS_OK);
      for (size_t y = 0; y < window.height; ++y) {
        const auto row = all.begin() + 2 * static_cast<ptrdiff_t>((window.y + y) * 150 + window.x);
        ASSERT_TRUE(std::equal(row, row + 2 * window.width, out.begin() + 2 * y * window.width));
      }
    }
  }
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

TEST(RingStream, RefusesWhatIsNotDoneYet) {
  const Raster raster = globe(40, 21);
  const Raster picture = photograph();
  const tks_image image = picture.image();
  tks_encode_options windows = inRegions(lossless());
  windows.index = TKS_INDEX_WINDOWS;
  EXPECT_EQ(statusOf(goingRound(raster), &image, lossless()), TKS_UNSUPPORTED);
  EXPECT_EQ(statusOf(goingRound(raster), nullptr, windows), TKS_UNSUPPORTED);
  EXPECT_EQ(statusOf(raster.heights(), &image, lossless()), TKS_OK);
}

}  // namespace
}  // namespace tetrakis::test
