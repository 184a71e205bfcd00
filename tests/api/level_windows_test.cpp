// SPDX-License-Identifier: Apache-2.0
// Windows of mip levels hold what the level holds there, of whatever is in a stream.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

/// One component of a stream at one level.
struct Level {
  tks_part part;
  uint32_t width, height;
  size_t bytes;  ///< of a place

  tks_status decode(tks_decoder* decoder, const tks_window* window, std::vector<std::byte>& out) {
    const bool texture = part == TKS_PART_TEXTURE;
    out.resize(
        (window != nullptr ? size_t{window->width} * window->height : size_t{width} * height) *
        bytes);
    if (window == nullptr)
      return texture ? tks_decode_texture(decoder, out.data(), out.size())
                     : tks_decode_heights(decoder, out.data(), out.size());
    return texture ? tks_decode_texture_window(decoder, window, out.data(), out.size())
                   : tks_decode_heights_window(decoder, window, out.data(), out.size());
  }
};

/// A stream, and another decoder of it that decodes windows alone.
void expectWindowsOf(Prefix prefix, std::mt19937& random) {
  const Stream opened(prefix);
  if (opened.status() != TKS_OK) return;
  const tks_info info = opened.info();
  for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE}) {
    const bool texture = part == TKS_PART_TEXTURE;
    if (!(texture ? info.has_texture : info.has_heights)) continue;
    const uint32_t coarsest = texture ? info.texture_coarsest_level : info.coarsest_level;
    Stream windows(prefix);
    for (uint32_t level = 0; level <= coarsest; ++level) {
      Stream whole(prefix);
      ASSERT_EQ(tks_set_levels(whole.get(), texture ? 0 : level, texture ? level : 0), TKS_OK);
      ASSERT_EQ(tks_set_levels(windows.get(), texture ? 0 : level, texture ? level : 0), TKS_OK);
      tks_info at = {};
      at.size = sizeof at;
      ASSERT_EQ(tks_get_info(whole.get(), &at), TKS_OK);
      Level shows{part, texture ? at.texture_width : at.width,
                  texture ? at.texture_height : at.height,
                  texture ? tks_sample_bytes(info.texture_sample) * info.texture_channels
                          : tks_sample_bytes(info.sample)};
      std::vector<std::byte> all, some;
      ASSERT_EQ(shows.decode(whole.get(), nullptr, all), TKS_OK) << tks_message(whole.get());
      const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
      tks_window window = {};
      window.width = 1 + below(std::min(shows.width, 40u));
      window.height = 1 + below(std::min(shows.height, 40u));
      window.x = below(shows.width - window.width + 1);
      window.y = below(shows.height - window.height + 1);
      ASSERT_EQ(shows.decode(windows.get(), &window, some), TKS_OK) << tks_message(windows.get());
      const size_t row = window.width * shows.bytes;
      for (size_t y = 0; y < window.height; ++y) {
        const size_t from = ((window.y + y) * shows.width + window.x) * shows.bytes;
        ASSERT_TRUE(std::equal(some.begin() + static_cast<ptrdiff_t>(y * row),
                               some.begin() + static_cast<ptrdiff_t>((y + 1) * row),
                               all.begin() + static_cast<ptrdiff_t>(from)))
            << "level " << level << ", row " << y << " of " << window.width << " x "
            << window.height << " at " << window.x << ", " << window.y;
      }
    }
  }
}

Bytes contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

TEST(LevelWindows, HoldWhatLevelsHoldThere) {
  std::mt19937 random(11);
  size_t streams = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TETRAKIS_VECTORS)) {
    if (entry.path().extension() != ".tks") continue;
    const Bytes bytes = contentOf(entry.path());
    for (const size_t end : {bytes.size(), bytes.size() * 3 / 5}) {
      ASSERT_NO_FATAL_FAILURE(expectWindowsOf(Prefix(bytes).first(end), random))
          << entry.path().filename() << ", " << end << " bytes";
    }
    ++streams;
  }
  EXPECT_GT(streams, 200u);
}

/// A window of a coarse level needs little of a stream in regions.
TEST(LevelWindows, NeedWhatLiesNearThem) {
  const samples::Raster heights =
      samples::make({samples::Pattern::kRidges, 900, 700, 1, TKS_I16, 3});
  tks_encode_options options = inRegions(lossless(), 64);
  options.index = TKS_INDEX_WINDOWS;
  const Bytes bytes = encode(&heights, nullptr, options);
  Stream stream((Prefix(bytes)));
  const auto neededOf = [&](uint32_t level, const tks_window& window) {
    EXPECT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
    tks_ranges ranges = {};
    EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
    uint64_t needed = 0;
    for (size_t i = 0; i < ranges.count; ++i) needed += ranges.ranges[i].size;
    tks_free_ranges(&ranges);
    return needed;
  };
  const uint64_t fine = neededOf(0, {100, 100, 64, 64}), coarse = neededOf(2, {25, 25, 16, 16});
  EXPECT_LE(coarse, fine);
  EXPECT_LT(fine, bytes.size() / 4);
  EXPECT_LT(neededOf(3, {0, 0, 113, 88}), bytes.size() / 8);
}

}  // namespace
}  // namespace tetrakis::test
