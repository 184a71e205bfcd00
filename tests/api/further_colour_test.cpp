// SPDX-License-Identifier: Apache-2.0
// Whole streams of textures whose last of 2 or 4 channels is a further colour, such as near
// infrared, and no alpha.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "conformance/samples/few_texels.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/texture_agreement.hpp"

namespace tetrakis::test {
namespace {

tks_encode_options quality(double psnr) {
  tks_encode_options options = {};
  options.size = sizeof options;
  options.psnr = psnr;
  return options;
}

using samples::make;
using samples::Pattern;
using samples::Raster;

Raster colours(Pattern pattern, uint32_t width, uint32_t height, uint32_t channels,
               tks_sample sample) {
  Raster image = make({pattern, width, height, channels, sample, 3});
  image.opaque = true;
  return image;
}

TEST(FurtherColour, ComesBackInAnyShape) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    for (const tks_sample sample : {TKS_U8, TKS_U16}) {
      for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
        for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 30u}, {2u, 3u}, {61u, 40u}}) {
          SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + " x " +
                       std::to_string(channels) + " of pattern " +
                       std::to_string(static_cast<int>(pattern)));
          const Raster image = colours(pattern, width, height, channels, sample);
          const Bytes stream = encode(nullptr, &image, lossless());
          EXPECT_TRUE(Stream(stream).texture() == image.data);
          EXPECT_EQ(Stream(stream).info().texture_opaque, 1);
          expectTextureAgreement(stream);
        }
      }
    }
  }
}

TEST(FurtherColour, AlphaIsToldApart) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    Raster image = colours(Pattern::kRidges, 20, 30, channels, TKS_U8);
    image.opaque = false;
    EXPECT_EQ(Stream(encode(nullptr, &image, lossless())).info().texture_opaque, channels % 2);
  }
}

/// Which a cut-out would not do: colours stay where the further one is 0.
TEST(FurtherColour, OfTwoValuesHidesNothing) {
  for (const uint32_t channels : {2u, 4u}) {
    Raster image = colours(Pattern::kRidges, 64, 48, channels, TKS_U8);
    samples::cutOut(image, samples::validity(samples::VoidShape::kCoast, 64, 48));
    for (const tks_encode_options& options : {lossless(), quality(60)}) {
      const Bytes stream = encode(nullptr, &image, options);
      EXPECT_EQ(Stream(stream).info().texture_cutout, 0);
      const std::vector<std::byte> texels = Stream(stream).texture();
      for (size_t i = 0; i < texels.size(); ++i) {
        ASSERT_NEAR(std::to_integer<int>(texels[i]), std::to_integer<int>(image.data[i]), 8);
      }
    }
  }
}

/// Prefixes, levels, budgets and regions, against the reference decoder.
TEST(FurtherColour, PrefixesAreWhatTheTextSays) {
  for (const uint32_t channels : {2u, 4u}) {
    for (const bool few : {false, true}) {
      Raster image = colours(Pattern::kRidges, 45, 39, channels, TKS_U8);
      if (few) image = samples::withFewTexels(image, 60, TKS_U16);
      image.opaque = true;
      tks_encode_options in_regions = lossless();
      in_regions.regions = 16;
      for (const tks_encode_options& options : {lossless(), budget(700), in_regions}) {
        const Bytes stream = encode(nullptr, &image, options);
        for (size_t cut = 0; cut <= stream.size(); cut += 1 + stream.size() / 37)
          expectTextureAgreement(Prefix(stream).first(cut), 0);
        for (const int level : {1, 3}) expectTextureAgreement(stream, level);
      }
    }
  }
}

/// A colour that is the mean of others, and a little noise, costs about its noise.
TEST(FurtherColour, FollowsTheOthers) {
  Raster image = colours(Pattern::kRidges, 160, 120, 4, TKS_U8);
  Raster three{image.width, image.height, 3, TKS_U8, {}};
  for (size_t i = 0; i < image.data.size(); i += 4) {
    const int red = std::to_integer<int>(image.data[i]),
              blue = std::to_integer<int>(image.data[i + 2]);
    const auto noise = static_cast<int>(samples::hash(static_cast<uint32_t>(i), 1, 2) % 3);
    image.data[i + 3] = static_cast<std::byte>(std::min(255, 20 + (red + blue) / 3 + noise));
    three.data.insert(three.data.end(), image.data.begin() + static_cast<ptrdiff_t>(i),
                      image.data.begin() + static_cast<ptrdiff_t>(i) + 3);
  }
  const size_t with = encode(nullptr, &image, lossless()).size();
  const size_t without = encode(nullptr, &three, lossless()).size();
  const double bits = 8. * static_cast<double>(with - without) / (160 * 120);
  EXPECT_LT(bits, 2.5);  // the noise has 1.58
  image.opaque = false;
  EXPECT_LT(with, encode(nullptr, &image, lossless()).size());
}

}  // namespace
}  // namespace tetrakis::test
