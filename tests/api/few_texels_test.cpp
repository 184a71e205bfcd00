// SPDX-License-Identifier: Apache-2.0
// Whole streams of textures whose channels have few values, which tables hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "conformance/samples/few_texels.hpp"
#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/texture_agreement.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;
using samples::withFewTexels;

Raster ridges(uint32_t width, uint32_t height, uint32_t channels) {
  return make({Pattern::kRidges, width, height, channels, TKS_U8, 3});
}

bool hasTables(const Bytes& stream) {
  return readHeader(stream)->header.texture->tables.present;
}

TEST(FewTexels, TakeLittleMoreThanTheirPlaces) {
  const Raster whole = ridges(200, 150, 3);
  const size_t plain = encode(nullptr, &whole, lossless()).size();
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    for (const uint32_t levels : {256u, 150u, 60u, 20u}) {
      SCOPED_TRACE(std::to_string(levels) + " levels of type " + std::to_string(sample));
      const Raster image = withFewTexels(whole, levels, sample);
      const Bytes stream = encode(nullptr, &image, lossless());
      EXPECT_TRUE(Stream(stream).texture() == image.data);
      EXPECT_EQ(Stream(stream).info().lossless, 1);
      EXPECT_LT(stream.size(), plain + plain / 50 + 400);
    }
  }
}

/// As a saturated texel of a sensor of ten bits, whose samples are kept in the high ones of 16.
TEST(FewTexels, OneFarAboveAllOthersCostsNothing) {
  Raster image = ridges(160, 150, 1);
  image.sample = TKS_U16;
  std::vector<std::byte> samples(2 * image.data.size());
  for (size_t i = 0; i < image.data.size(); ++i) {
    const auto sample = static_cast<uint16_t>(std::to_integer<int>(image.data[i]) * 4);
    std::memcpy(&samples[2 * i], &sample, sizeof sample);
  }
  image.data = samples;
  const size_t usual = encode(nullptr, &image, lossless()).size();
  std::fill_n(image.data.begin() + 24000, 2, std::byte{0xff});
  const Bytes stream = encode(nullptr, &image, lossless());
  EXPECT_TRUE(Stream(stream).texture() == image.data);
  EXPECT_LT(stream.size(), usual + usual / 50);
}

/// Channels of any kind, awkward sizes, masks, overlays: they come back, whatever is chosen.
TEST(FewTexels, ComeBackInAnyShape) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    for (const auto& [width, height] : {std::pair{1u, 90u}, {70u, 1u}, {2u, 3u}, {61u, 40u}}) {
      for (const uint32_t levels : {2u, 17u, 130u}) {
        SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + " x " +
                     std::to_string(channels) + ", levels " + std::to_string(levels));
        Raster image = withFewTexels(ridges(width, height, channels), levels, TKS_U16);
        for (const bool masked : {false, true}) {
          const auto mask = samples::validity(samples::VoidShape::kCoast, width, height);
          if (masked) samples::drawOver(image, mask);
          if (masked && channels % 2 == 0) samples::cutOut(image, mask);
          const Bytes stream = encode(nullptr, &image, lossless());
          ASSERT_TRUE(Stream(stream).texture() == image.data);
          expectTextureAgreement(stream);
        }
      }
    }
  }
}

TEST(FewTexels, EveryPrefixAndLevelAgreesWithTheText) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    const Raster image = withFewTexels(ridges(50, 41, 3), 90, sample);
    for (const uint32_t regions : {0u, 16u}) {
      const Bytes stream = encode(nullptr, &image, inRegions(lossless(), regions));
      ASSERT_TRUE(hasTables(stream));
      for (size_t bytes = 0; bytes <= stream.size(); bytes += 37) {
        SCOPED_TRACE(bytes);
        expectTextureAgreement(Prefix(stream).first(bytes));
        if (HasFatalFailure()) return;
      }
      for (int level = 0; level < 4; ++level) expectTextureAgreement(stream, level);
    }
  }
}

TEST(FewTexels, DamagedHeadersAgreeWithTheText) {
  const Raster image = withFewTexels(ridges(60, 33, 2), 200, TKS_U16);
  const Bytes good = encode(nullptr, &image, lossless());
  ASSERT_TRUE(hasTables(good));
  const size_t header = static_cast<size_t>(Stream(good).info().header_bytes);
  for (size_t at = 8; at + 4 < header; ++at) {
    for (const int change : {1, 4, 127, 128, 255}) {
      SCOPED_TRACE(std::to_string(at) + " changed by " + std::to_string(change));
      Bytes damaged = good;
      damaged[at] ^= static_cast<uint8_t>(change);
      sealHeader(damaged);
      expectTextureAgreement(damaged);
      if (HasFatalFailure()) return;
    }
  }
}

/// Lossy textures know no tables, but lossless ones may serve their targets.
TEST(FewTexels, NoTargetTakesMoreBytesThanTheLastBit) {
  const Raster whole = ridges(200, 150, 3);
  for (const uint32_t levels : {150u, 60u}) {
    const Raster image = withFewTexels(whole, levels, TKS_U8);
    const size_t most = encode(nullptr, &image, lossless()).size() + 16;
    const Bytes budgeted = encode(nullptr, &image, budget(3 * most));
    EXPECT_LE(budgeted.size(), most);
    EXPECT_TRUE(Stream(budgeted).texture() == image.data);
    tks_encode_options psnr = budget(0);
    psnr.psnr = 70;
    EXPECT_LE(encode(nullptr, &image, psnr).size(), most);
  }
}

/// Between places lies what lies between their values, so that cuts stay good.
TEST(FewTexels, CutsAreNearlyAsGoodAsThoseOfLossyStreams) {
  const Raster image = withFewTexels(ridges(200, 150, 3), 150, TKS_U16);
  const Bytes stream = encode(nullptr, &image, lossless());
  ASSERT_TRUE(hasTables(stream));
  const auto squares = [&](Prefix prefix) {
    const std::vector<std::byte> shown = Stream(prefix).texture();
    double sum = 0;
    for (size_t i = 0; i < image.data.size() / 2; ++i) {
      const double error = sampleAt(shown, TKS_U16, i) - sampleAt(image.data, TKS_U16, i);
      sum += error * error;
    }
    return sum;
  };
  for (const size_t part : {16, 8, 4}) {
    const size_t bytes = stream.size() / part;
    const double lossy = squares(encode(nullptr, &image, budget(bytes)));
    EXPECT_LT(10 * std::log10(squares(Prefix(stream).first(bytes)) / lossy), 3.5) << part;
  }
}

/// What uses all of its values is coded as ever.
TEST(FewTexels, ImagesOfAllValuesHaveNoTables) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    const Raster image = make({Pattern::kRidges, 200, 150, 3, sample, 3});
    EXPECT_FALSE(sample == TKS_U8 && hasTables(encode(nullptr, &image, lossless())));
  }
}

}  // namespace
}  // namespace tetrakis::test
