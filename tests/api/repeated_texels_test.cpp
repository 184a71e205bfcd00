// SPDX-License-Identifier: Apache-2.0
// Whole streams of textures that were enlarged by copying texels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/few_texels.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// Nearest neighbours of so many columns and rows of an image.
Raster enlarged(const Raster& of, uint32_t width, uint32_t height) {
  Raster out = of;
  out.width = width;
  out.height = height;
  out.data.clear();
  const size_t bytes = tks_sample_bytes(of.sample) * of.channels;
  for (uint32_t y = 0; y < height; ++y) {
    const size_t row = uint64_t{y} * of.height / height;
    for (uint32_t x = 0; x < width; ++x) {
      const size_t from = row * of.width + uint64_t{x} * of.width / width;
      const auto texel = of.data.begin() + static_cast<ptrdiff_t>(from * bytes);
      out.data.insert(out.data.end(), texel, texel + static_cast<ptrdiff_t>(bytes));
    }
  }
  return out;
}

Raster ridges(uint32_t channels = 3, tks_sample sample = TKS_U8) {
  return make({Pattern::kRidges, 41, 33, channels, sample, 3});
}

bool repeats(const Bytes& stream) {
  return !readHeader(stream)->header.texture->repeats.none();
}

double squaredError(const Raster& truth, const std::vector<std::byte>& shown) {
  double squares = 0;
  for (size_t i = 0; i < truth.data.size() / tks_sample_bytes(truth.sample); ++i) {
    const double error = sampleAt(shown, truth.sample, i) - sampleAt(truth.data, truth.sample, i);
    squares += error * error;
  }
  return squares;
}

TEST(RepeatedTexels, CostTheirMapAlone) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    for (const tks_sample sample : {TKS_U8, TKS_U16}) {
      const Raster of = ridges(channels, sample);
      const size_t alone = encode(nullptr, &of, lossless()).size();
      for (const auto& [width, height] :
           {std::pair{82u, 66u}, {123u, 33u}, {41u, 132u}, {61u, 47u}}) {
        SCOPED_TRACE(std::to_string(channels) + " channels, " + std::to_string(width) + " x " +
                     std::to_string(height));
        const Raster large = enlarged(of, width, height);
        const Bytes stream = encode(nullptr, &large, lossless());
        EXPECT_TRUE(repeats(stream));
        EXPECT_TRUE(Stream(stream).texture() == large.data);
        EXPECT_LT(stream.size(), alone + 40);
      }
    }
  }
}

/// Few values, drawings, masks and stored noise are found in the lines that are coded.
TEST(RepeatedTexels, HaveTheToolsOfTheirLines) {
  const auto expectBack = [](const Raster& of) {
    const Raster large = enlarged(of, 2 * of.width, 3 * of.height);
    const Bytes stream = encode(nullptr, &large, lossless());
    EXPECT_TRUE(repeats(stream));
    EXPECT_TRUE(Stream(stream).texture() == large.data);
    const auto decoded = reference::decode(stream, 1 << 20, {0, 0});
    ASSERT_TRUE(decoded.texture.has_value());
    EXPECT_TRUE(
        std::equal(large.data.begin(), large.data.end(), decoded.texture->begin(),
                   [](std::byte a, uint8_t b) { return std::to_integer<uint8_t>(a) == b; }));
  };
  expectBack(samples::withFewTexels(ridges(), 100, TKS_U16));
  expectBack(make({Pattern::kSteps, 60, 41, 3, TKS_U8, 3}));
  expectBack(make({Pattern::kExtreme, 21, 13, 2, TKS_U16, 3}));
  Raster cut = ridges(4);
  samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, cut.width, cut.height));
  expectBack(cut);
}

TEST(RepeatedTexels, DecodeAsTheReferenceDoesInAllPrefixesAndLevels) {
  const Raster large = enlarged(ridges(), 103, 97);
  for (const tks_encode_options& options :
       {lossless(), budget(900), inRegions(lossless()), inRegions(budget(900))}) {
    const Bytes stream = encode(nullptr, &large, options);
    ASSERT_TRUE(repeats(stream));
    for (size_t bytes = readHeader(stream)->bytes; bytes <= stream.size(); bytes += 141) {
      const Prefix prefix = Prefix(stream).first(bytes);
      for (const uint32_t level : {0u, 1u, 2u, 3u, 5u}) {
        Stream decoded(prefix);
        ASSERT_EQ(tks_set_levels(decoded.get(), 0, level), TKS_OK);
        const size_t columns = ((large.width - 1) >> level) + 1;
        const size_t rows = ((large.height - 1) >> level) + 1;
        std::vector<uint8_t> texels(3 * columns * rows);
        ASSERT_EQ(tks_decode_texture(decoded.get(), texels.data(), texels.size()), TKS_OK);
        ASSERT_EQ(texels, reference::decode(prefix, 1 << 20, {0, static_cast<int>(level)}).texture)
            << bytes << ", level " << level;
      }
    }
  }
}

TEST(RepeatedTexels, WindowsAreThoseOfTheWhole) {
  const Raster large = enlarged(ridges(), 123, 80);
  for (const tks_encode_options& options : {budget(900), inRegions(lossless())}) {
    const Bytes stream = encode(nullptr, &large, options);
    const std::vector<std::byte> whole = Stream(stream).texture();
    for (const tks_window& window : {tks_window{0, 0, large.width, large.height},
                                     tks_window{31, 40, 20, 3}, tks_window{122, 79, 1, 1}})
      expectTextureWindow(Stream(stream), window, whole);
  }
}

/// The ranges that a window needs suffice for it.
TEST(RepeatedTexels, AWindowNeedsItsRangesAlone) {
  const Raster large = enlarged(make({Pattern::kRidges, 120, 110, 3, TKS_U8, 3}), 240, 330);
  tks_encode_options options = inRegions(lossless());
  options.index = TKS_INDEX_WINDOWS;
  const Bytes stream = encode(nullptr, &large, options);
  ASSERT_TRUE(repeats(stream));
  const std::vector<std::byte> whole = Stream(stream).texture();
  const size_t header = readHeader(stream)->bytes;
  Stream some(Prefix(stream).first(header));
  const tks_window window{3, 5, 20, 10};
  tks_ranges ranges = {};
  ASSERT_EQ(tks_needed_ranges(some.get(), TKS_PART_TEXTURE, &window, &ranges), TKS_OK);
  size_t bytes = 0;
  for (size_t i = 0; i < ranges.count; ++i) {
    const tks_range& range = ranges.ranges[i];
    bytes += range.size;
    ASSERT_EQ(tks_put(some.get(), range.offset, stream.data() + range.offset, range.size), TKS_OK);
  }
  tks_free_ranges(&ranges);
  EXPECT_LT(bytes, stream.size() - header);
  expectTextureWindow(some, window, whole);
}

TEST(RepeatedTexels, MeetTargets) {
  const Raster of = ridges();
  for (const auto& [width, height] : {std::pair{82u, 132u}, {61u, 50u}}) {
    const Raster large = enlarged(of, width, height);
    tks_encode_options psnr = budget(0);
    psnr.psnr = 38;
    const Bytes reached = encode(nullptr, &large, psnr);
    const double mean =
        squaredError(large, Stream(reached).texture()) / static_cast<double>(large.data.size());
    EXPECT_GE(10 * std::log10(255 * 255 / mean), 38);
    const Bytes less = encode(nullptr, &large, budget(700));
    EXPECT_LE(less.size(), 700u);
  }
}

/// Beside heights whose lines repeat as well.
TEST(RepeatedTexels, LieOverHeights) {
  const Raster heights = enlarged(make({Pattern::kRidges, 30, 22, 1, TKS_I16, 5}), 60, 66);
  const Raster image = enlarged(ridges(), 123, 66);
  for (const tks_encode_options& options : {lossless(), budget(3000)}) {
    const Bytes stream = encode(&heights, &image, options);
    EXPECT_TRUE(repeats(stream));
    EXPECT_FALSE(readHeader(stream)->header.geometry->repeats.none());
    const auto decoded = reference::decode(stream, 1 << 20, {0, 0});
    const std::vector<std::byte> texels = Stream(stream).texture();
    EXPECT_TRUE(
        std::equal(texels.begin(), texels.end(), decoded.texture->begin(),
                   [](std::byte a, uint8_t b) { return std::to_integer<uint8_t>(a) == b; }));
    EXPECT_TRUE(!options.lossless || texels == image.data);
  }
}

/// A georeference of the texture is that of all texels.
TEST(RepeatedTexels, KeepTheirPlace) {
  const Raster large = enlarged(ridges(), 82, 66);
  tks_image image = large.image();
  const double place[] = {399960, 15, 0, 5300040, 0, -15};
  std::copy_n(place, 6, image.geotransform);
  image.has_geotransform = 1;
  const Bytes stream = encodeGiven(nullptr, &image, lossless());
  ASSERT_TRUE(repeats(stream));
  Stream decoded(stream);
  EXPECT_EQ(decoded.info().texture_width, 82u);
  EXPECT_TRUE(std::equal(place, place + 6,
                         readHeader(stream)->header.georeference.texture.transform.begin()));
}

TEST(RepeatedTexels, AreNoneWhereOnlyAFewAre) {
  Raster image = ridges();
  std::fill_n(image.data.begin(), size_t{3} * 41 * 12, std::byte{0});
  EXPECT_FALSE(repeats(encode(nullptr, &image, lossless())));
}

}  // namespace
}  // namespace tetrakis::test
