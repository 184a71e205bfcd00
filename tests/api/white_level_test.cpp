// SPDX-License-Identifier: Apache-2.0
// Textures that use a part of their 16 bits: what counts as white, and what follows from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/samples.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/texture_agreement.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

std::span<uint16_t> words(Raster& image) {
  return {reinterpret_cast<uint16_t*>(image.data.data()), image.data.size() / 2};
}

/// Reflectances: values from 200 to about `most`, which few reach.
Raster reflectances(uint32_t channels, uint32_t most) {
  Raster image = make({Pattern::kRidges, 96, 80, channels, TKS_U16, 5});
  for (uint16_t& word : words(image))
    word = static_cast<uint16_t>(200 + word * (most - 200) / 65535);
  return image;
}

tks_encode_options reaching(double psnr) {
  tks_encode_options options = budget(0);
  options.psnr = psnr;
  return options;
}

uint32_t found(const Raster& image) {
  const tks_image known = image.image();
  return tks_find_white_level(&known);
}

double psnrOf(const Raster& truth, const std::vector<std::byte>& decoded, double white) {
  double sum = 0;
  const size_t count = truth.data.size() / 2;
  for (size_t i = 0; i < count; ++i)
    sum += std::pow(sampleAt(truth.data, TKS_U16, i) - sampleAt(decoded, TKS_U16, i), 2);
  return 10 * std::log10(white * white / (sum / static_cast<double>(count)));
}

TEST(WhiteLevel, IsFoundWhereColoursEnd) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    for (const uint32_t most : {250u, 1000u, 4095u, 10000u}) {
      SCOPED_TRACE(std::to_string(channels) + " channels to " + std::to_string(most));
      Raster image = reflectances(channels, most);
      image.opaque = true;
      EXPECT_LE(found(image), most);
      EXPECT_GE(found(image), most / 2);
    }
  }
}

TEST(WhiteLevel, IsTheLargestValueOfOthers) {
  EXPECT_EQ(found(make({Pattern::kRidges, 40, 30, 3, TKS_U16, 5})), 65535u);
  EXPECT_EQ(found(make({Pattern::kRidges, 40, 30, 3, TKS_U8, 5})), 255u);
  EXPECT_EQ(found(reflectances(4, 3000)), 65535u);  // an alpha of more than two values
  Raster black = make({Pattern::kFlat, 9, 9, 1, TKS_U16, 5});
  std::fill(black.data.begin(), black.data.end(), std::byte{0});
  EXPECT_EQ(found(black), 65535u);
  EXPECT_EQ(tks_find_white_level(nullptr), 0u);
  tks_image none = black.image();
  none.data = nullptr;
  EXPECT_EQ(tks_find_white_level(&none), 0u);
}

/// Clouds, borders of zeros and what an alpha hides.
TEST(WhiteLevel, DoesNotFollowWhatIsRareOrHidden) {
  Raster image = reflectances(4, 3000);
  samples::cutOut(image, samples::validity(samples::VoidShape::kCoast, image.width, image.height));
  const auto texels = words(image);
  const uint32_t before = found(image);
  for (size_t i = 0; i < texels.size(); i += 4) {
    if (texels[i + 3] == 0) texels[i] = 60000;
    if (texels[i + 3] != 0 && i % 400 == 0) texels[i] = texels[i + 1] = texels[i + 2] = 30000;
  }
  EXPECT_NEAR(found(image), before, before * 0.3);
  Raster bordered = reflectances(3, 3000);
  const uint32_t whole = found(bordered);
  std::fill_n(words(bordered).begin(), words(bordered).size() / 2, uint16_t{0});
  EXPECT_NEAR(found(bordered), whole, whole * 0.2);
}

TEST(WhiteLevel, IsStatedAndChangesNoSample) {
  for (const uint32_t white : {0u, 1u, 700u, 65534u, 65535u}) {
    for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
      const Raster texture = make({pattern, 37, 29, 3, TKS_U16, 5});
      tks_image image = texture.image();
      image.white_level = white;
      const Bytes bytes = encodeGiven(nullptr, &image, lossless());
      EXPECT_EQ(Stream(bytes).info().texture_white_level, white == 0 ? found(texture) : white);
      EXPECT_TRUE(Stream(bytes).texture() == texture.data);
      expectTextureAgreement(bytes);
    }
  }
}

TEST(WhiteLevel, IsWhatQualityRefersTo) {
  const Raster image = reflectances(3, 4000);
  const uint32_t white = found(image);
  const Bytes stream = encode(nullptr, &image, reaching(40));
  const double psnr = psnrOf(image, Stream(stream).texture(), white);
  EXPECT_GE(psnr, 40);
  EXPECT_LE(psnr, 42);
  EXPECT_NEAR(Stream(stream).info().texture_psnr, psnr, 0.5);
}

/// The texture that uses all of its bits gets as many bytes beside heights as this one.
TEST(WhiteLevel, SharesBytesAsItsPictureDoes) {
  const Raster heights = make({Pattern::kRidges, 96, 80, 1, TKS_U16, 3});
  const Raster dark = reflectances(3, 3000);
  Raster bright = dark;
  const uint32_t white = found(dark);
  for (uint16_t& word : words(bright))
    word = static_cast<uint16_t>(std::min(65535u, word * 65535u / white));
  const auto share = [&](const Raster& raster, uint32_t level) {
    const tks_heights ground = heights.heights();
    tks_image image = raster.image();
    image.white_level = level;
    const Bytes stream = encodeGiven(&ground, &image, budget(6000));
    return static_cast<double>(Stream(stream).info().texture_bytes);
  };
  EXPECT_NEAR(share(dark, 0), share(bright, 0), share(bright, 0) * 0.2);
  EXPECT_LT(share(dark, 65535), share(bright, 0) * 0.5);
}

TEST(WhiteLevel, IsRefusedWhereItIsNone) {
  const Raster bytes = make({Pattern::kRidges, 9, 9, 1, TKS_U8, 5});
  const Raster texels = make({Pattern::kRidges, 9, 9, 1, TKS_U16, 5});
  const auto refused = [](const Raster& raster, uint32_t white) {
    tks_image image = raster.image();
    image.white_level = white;
    const tks_encode_options options = lossless();
    tks_buffer buffer = {};
    const tks_status status = tks_encode(nullptr, &image, &options, &buffer, nullptr, 0);
    tks_free_buffer(&buffer);
    return status == TKS_USAGE;
  };
  EXPECT_TRUE(refused(bytes, 200));
  EXPECT_TRUE(refused(bytes, 256));
  EXPECT_FALSE(refused(bytes, 255));
  EXPECT_TRUE(refused(texels, 65536));
  EXPECT_FALSE(refused(texels, 65535));
}

TEST(WhiteLevel, SpansEightBits) {
  for (const uint32_t white : {1u, 2u, 254u, 255u, 256u, 3000u, 65534u, 65535u}) {
    EXPECT_EQ(shownIn8Bits(0, white), 0);
    EXPECT_EQ(shownIn8Bits(white, white), 255);
    EXPECT_EQ(shownIn8Bits(65535, white), 255);
    for (uint32_t v = 1; v <= 65535; ++v)
      ASSERT_GE(shownIn8Bits(v, white), shownIn8Bits(v - 1, white)) << v << " of " << white;
  }
  for (uint32_t v = 0; v <= 255; ++v) EXPECT_EQ(shownIn8Bits(v, 255), v);
}

}  // namespace
}  // namespace tetrakis::test
