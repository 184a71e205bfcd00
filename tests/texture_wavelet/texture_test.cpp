// SPDX-License-Identifier: Apache-2.0
// Texture tracks: lossless ends, prefixes, limits, hostile input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/texel_errors.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {
namespace {

/// Waves and noise; channels share most of their structure, as colours do.
Texels makeTexels(uint32_t width, uint32_t height, uint32_t channels, int bits, uint32_t noise) {
  std::mt19937 random(width * 31 + height * 7 + channels);
  Texels texels{width, height, channels, bits, {}};
  const double peak = (1 << bits) - 1;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double luma = 0.5 + 0.3 * std::sin(0.21 * x) * std::cos(0.13 * y);
      for (uint32_t c = 0; c < channels; ++c) {
        const double value = (luma + 0.05 * c) * peak + static_cast<double>(random() % (noise + 1));
        texels.samples.push_back(static_cast<uint16_t>(std::clamp(value, 0.0, peak)));
      }
    }
  }
  return texels;
}

TEST(TextureTrack, IsLosslessAtItsEnd) {
  for (const auto& [width, height] :
       {std::pair{1u, 1u}, {1u, 9u}, {2u, 2u}, {5u, 3u}, {17u, 31u}, {64u, 64u}, {3u, 300u}}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const int bits : {8, 16}) {
        const Texels texels = makeTexels(width, height, channels, bits, 40);
        const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
        ASSERT_TRUE(encoded.tracks.front().complete);
        EXPECT_EQ(decodeTexture(encoded.header, {encoded.tracks.front().codeword}).samples,
                  texels.samples)
            << width << " x " << height << " x " << channels << ", " << bits << " bits";
      }
    }
  }
}

/// Errors of 2 x 2 means: what is left of an error from afar.
double coarseError(const Texels& a, const Texels& b) {
  double sum = 0;
  const size_t row = size_t{a.width} * a.channels;
  for (uint32_t y = 0; y + 1 < a.height; y += 2) {
    for (size_t i = y * row; i + a.channels < (y + 1) * row; ++i) {
      if (i / a.channels % 2 != 0) continue;
      double error = 0;
      for (const size_t k : {i, i + a.channels, i + row, i + row + a.channels})
        error += a.samples[k] - b.samples[k];
      sum += error * error;
    }
  }
  return sum;
}

/// Visual weights: coarse errors fall at the cost of fine ones; the last bit comes all the same.
TEST(TextureTrack, VisualWeightsPutCoarseErrorsFirst) {
  for (const uint32_t channels : {1u, 3u, 4u}) {
    const Texels texels = makeTexels(96, 80, channels, 8, 60);
    const EncodedTexture plain = encodeTexture(texels, Purpose::kLossless, {}),
                         visual = encodeTexture(texels, Purpose::kLossless, {.visual = true});
    EXPECT_EQ(plain.header.weights.levels, 0);
    const auto cut = [](const EncodedTexture& encoded, size_t bytes) {
      return decodeTexture(encoded.header,
                           {std::span(encoded.tracks.front().codeword).first(bytes)});
    };
    const size_t bytes = plain.tracks.front().codeword.size() / 6;
    const Texels a = cut(plain, bytes), b = cut(visual, bytes);
    EXPECT_LT(coarseError(texels, b), 0.95 * coarseError(texels, a)) << channels;
    EXPECT_GT(squaredError(texels, b), squaredError(texels, a)) << channels;
    EXPECT_EQ(cut(visual, visual.tracks.front().codeword.size()).samples, texels.samples);
  }
}

TEST(TextureTrack, FullRangeNoiseComesBack) {
  std::mt19937 random(5);
  for (const int bits : {8, 16}) {
    Texels texels{40, 23, 4, bits, std::vector<uint16_t>(40 * 23 * 4)};
    for (uint16_t& s : texels.samples) {
      s = static_cast<uint16_t>(random() % 2 == 0 ? 0 : (1 << bits) - 1);
    }
    const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
    EXPECT_EQ(decodeTexture(encoded.header, {encoded.tracks.front().codeword}).samples,
              texels.samples);
  }
}

/// Complete lossy tracks hold every bit of the fraction: only colours are rounded.
TEST(TextureTrack, LossyTracksEndCloseToTheImage) {
  for (const int bits : {8, 16}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      const Texels texels = makeTexels(33, 20, channels, bits, 40);
      const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossy, {});
      ASSERT_TRUE(encoded.tracks.front().complete);
      ASSERT_EQ(encoded.header.wavelet.fraction_bits, 4);
      EXPECT_EQ(decodeTexture(encoded.header, {encoded.tracks.front().codeword}).samples,
                texels.samples);
    }
  }
}

TEST(TextureTrack, StatedDistortionIsCloseToTheRealOne) {
  const Texels texels = makeTexels(160, 120, 3, 8, 30);
  const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossy, {});
  const auto& points = encoded.tracks.front().points;
  for (size_t i = 4; i < points.size(); i += 11) {
    if (points[i].distortion < static_cast<double>(texels.samples.size()) / 2)
      break;  // samples are rounded
    const Texels decoded = decodeTexture(
        encoded.header, {std::span(encoded.tracks.front().codeword).first(points[i].bytes)});
    const double ratio = squaredError(texels, decoded) / points[i].distortion;
    EXPECT_GT(ratio, 0.6) << i;
    EXPECT_LT(ratio, 1.5) << i;
  }
}

TEST(TextureTrack, StopsSoonAfterItsLimitWithTheSameBytes) {
  const Texels texels = makeTexels(90, 70, 3, 8, 60);
  const EncodedTexture full = encodeTexture(texels, Purpose::kLossy, {}),
                       cut = encodeTexture(texels, Purpose::kLossy, {3000});
  ASSERT_FALSE(cut.tracks.front().complete);
  ASSERT_GE(cut.tracks.front().codeword.size() + 4, 3000u) << "less the bytes that nothing needs";
  EXPECT_TRUE(std::equal(cut.tracks.front().codeword.begin(),
                         cut.tracks.front().codeword.begin() + 2990,
                         full.tracks.front().codeword.begin()));
}

TEST(TextureTrack, GreyInRgbCostsLittleMoreThanGrey) {
  const Texels grey = makeTexels(128, 128, 1, 8, 20);
  Texels colour{128, 128, 3, 8, {}};
  for (uint16_t s : grey.samples) colour.samples.insert(colour.samples.end(), 3, s);
  const double ratio =
      static_cast<double>(
          encodeTexture(colour, Purpose::kLossless, {}).tracks.front().codeword.size()) /
      static_cast<double>(
          encodeTexture(grey, Purpose::kLossless, {}).tracks.front().codeword.size());
  EXPECT_LT(ratio, 1.02);
}

TEST(TextureTrack, AnyBytesAndHeadersDecodeIntoRange) {
  std::mt19937 random(6);
  for (int run = 0; run < 300; ++run) {
    TextureHeader header;
    header.width = static_cast<uint32_t>(1 + random() % 40);
    header.height = static_cast<uint32_t>(1 + random() % 40);
    header.channels = static_cast<uint8_t>(1 + random() % 4);
    header.sample = random() % 2 == 0 ? TKS_U8 : TKS_U16;
    header.planes = static_cast<uint8_t>(random() % 31);
    header.colour_order = static_cast<uint8_t>(random() % 6);
    header.colour_shears.resize(1 + random() % 8);
    for (auto& shears : header.colour_shears) {
      for (int64_t& shear : shears) shear = static_cast<int64_t>(random() % 65535) - 32767;
    }
    for (int64_t& priority : header.priority) priority = static_cast<int64_t>(random() % 257) - 128;
    header.weights.levels = static_cast<uint8_t>(random() % (BandWeights::kMostLevels + 1));
    for (auto& of_component : header.weights.priority) {
      for (int64_t& priority : of_component) priority = static_cast<int64_t>(random() % 257) - 128;
    }
    for (uint8_t& filter : header.wavelet.filters) filter = static_cast<uint8_t>(random() % 4);
    header.wavelet.fraction_bits = static_cast<uint8_t>(random() % (kMaxFractionBits + 1));
    header.wavelet.bits = static_cast<uint8_t>(random() % 33);
    std::vector<uint8_t> bytes(random() % 400);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    const Texels texels = decodeTexture(header, {bytes});
    ASSERT_EQ(texels.samples.size(), size_t{header.width} * header.height * header.channels);
    for (const uint16_t s : texels.samples) ASSERT_EQ(s >> texels.bits, 0);
  }
}

}  // namespace
}  // namespace tetrakis
