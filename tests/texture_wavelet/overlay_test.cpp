// SPDX-License-Identifier: Apache-2.0
// Overlays: what is taken for one, that it is exact, and that the image below loses nothing.
#include "texture_wavelet/mask/mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;

Texels photograph(uint32_t channels, int bits) {
  std::mt19937 random(channels);
  Texels texels{kWidth, kHeight, channels, bits, {}};
  const double most = (1 << bits) - 1;
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const double wave = 0.5 + 0.3 * std::sin(0.06 * (i % kWidth)) * std::cos(0.05 * (i / kWidth));
    for (uint32_t c = 0; c < channels; ++c) {
      const double grain = 0.08 * static_cast<double>(random() % 100) / 100;
      texels.samples.push_back(static_cast<uint16_t>(most * (wave + grain)));
    }
  }
  return texels;
}

/// Bars of two colours; returns 1 for what is left of the photograph.
std::vector<uint8_t> drawBars(Texels& texels) {
  std::vector<uint8_t> left(kWidth * kHeight, 1);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const uint32_t x = i % kWidth, y = i / kWidth;
    const bool bar = (x / 3 + y / 20) % 9 == 0, other = (y + x / 16) % 31 < 2;
    if (!bar && !other) continue;
    left[i] = 0;
    for (uint32_t c = 0; c < texels.channels; ++c)
      texels.samples[size_t{i} * texels.channels + c] = static_cast<uint16_t>(bar ? 255 : 3 * c);
  }
  return left;
}

size_t wrongIn(const Texels& a, const Texels& b, const std::vector<uint8_t>& left) {
  size_t wrong = 0;
  for (size_t i = 0; i < a.samples.size(); ++i)
    wrong += !left[i / a.channels] && a.samples[i] != b.samples[i];
  return wrong;
}

double squaresIn(const Texels& a, const Texels& b, const std::vector<uint8_t>& left) {
  double squares = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    if (left[i / a.channels]) squares += std::pow(double{1} * a.samples[i] - b.samples[i], 2);
  }
  return squares;
}

TEST(Overlay, IsFoundTexelByTexel) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    Texels texels = photograph(channels, 16);
    EXPECT_TRUE(photographOf(texels).empty());
    const std::vector<uint8_t> left = drawBars(texels);
    EXPECT_EQ(photographOf(texels), left);
  }
  EXPECT_TRUE(photographOf({1, 1, 1, 8, {7}}).empty());
  EXPECT_TRUE(
      photographOf({kWidth, kHeight, 1, 8, std::vector<uint16_t>(kWidth * kHeight)}).empty());
}

TEST(Overlay, IsFoundInLinesOfOneTexel) {
  Texels texels = photograph(3, 8);
  std::vector<uint8_t> left(kWidth * kHeight, 1);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    if (i % kWidth % 31 != 7 && i / kWidth % 29 != 5) continue;
    left[i] = 0;
    std::fill_n(texels.samples.begin() + 3 * i, 3, uint16_t{255});
  }
  EXPECT_EQ(photographOf(texels), left);
}

TEST(Overlay, LosslessRestoresBoth) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    for (const int bits : {8, 16}) {
      Texels texels = photograph(channels, bits);
      const EncodedTexture plain = encodeTexture(texels, Purpose::kLossless, {});
      EXPECT_EQ(plain.header.overlay_bytes, 0u);
      drawBars(texels);
      const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
      ASSERT_GT(encoded.header.overlay_bytes, 0u) << channels << " " << bits;
      const std::vector<uint8_t>& codeword = encoded.tracks.front().codeword;
      EXPECT_EQ(decodeTexture(encoded.header, {codeword}).samples, texels.samples);
      EXPECT_LT(codeword.size(), plain.tracks.front().codeword.size() * 105 / 100)
          << "lettering costs next to nothing";
    }
  }
}

TEST(Overlay, IsExactFromItsLastByteOn) {
  Texels texels = photograph(3, 8);
  const std::vector<uint8_t> left = drawBars(texels);
  const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossy, {8000});
  ASSERT_GT(encoded.header.overlay_bytes, 0u);
  const std::span<const uint8_t> codeword = encoded.tracks.front().codeword;
  const auto overlay = static_cast<size_t>(encoded.header.overlay_bytes);
  double before = INFINITY;
  for (size_t bytes = overlay; bytes <= codeword.size(); bytes += 500) {
    const Texels decoded = decodeTexture(encoded.header, {codeword.first(bytes)});
    ASSERT_EQ(wrongIn(decoded, texels, left), 0u);
    const double squares = squaresIn(decoded, texels, left);
    EXPECT_LT(squares, before);
    before = squares;
  }
}

/// It lies ahead of everything, so that of a budget of which it takes most the prefixes are poor:
/// there a better end alone does not pay.
TEST(Overlay, IsLeftOutWhereItTakesMostOfTheBudget) {
  Texels texels = photograph(1, 8);
  std::mt19937 random(3);
  for (uint16_t& texel : texels.samples)
    if (texel < 90 + random() % 30) texel = 80;
  const auto overlayIn = [&](uint64_t room) {
    const TextureOptions options{.limit = 2 * room, .room = room};
    return encodeTexture(texels, Purpose::kLossy, options).header.overlay_bytes;
  };
  const uint64_t overlay = overlayIn(12000);
  ASSERT_GT(overlay, 0u);
  EXPECT_EQ(overlayIn(overlay + overlay / 4), 0u);
}

TEST(Overlay, EveryPrefixOfItDecodes) {
  Texels texels = photograph(2, 8);
  drawBars(texels);
  const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossy, {3000});
  ASSERT_GT(encoded.header.overlay_bytes, 0u);
  const std::span<const uint8_t> codeword = encoded.tracks.front().codeword;
  for (size_t bytes = 0; bytes <= encoded.header.overlay_bytes; bytes += 7) {
    const Texels decoded = decodeTexture(encoded.header, {codeword.first(bytes)});
    EXPECT_EQ(decoded.samples.size(), texels.samples.size());
  }
}

/// What a call leaves to the next changes nothing, wherever the overlay and the mask end.
TEST(Overlay, PrefixesThatGrowInOneMemoryDecodeAsAlone) {
  for (const uint32_t channels : {3u, 4u}) {
    Texels texels = photograph(channels, 8);
    drawBars(texels);
    for (size_t i = 3; channels == 4 && i < texels.samples.size(); i += 4)
      texels.samples[i] = i / 4 % kWidth < 30 ? 0 : 255;
    const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossy, {4000});
    const auto opening =
        static_cast<size_t>(encoded.header.overlay_bytes + encoded.header.alpha_bytes);
    ASSERT_GT(opening, 0u);
    const std::span<const uint8_t> codeword = encoded.tracks.front().codeword;
    TextureMemory memory;
    for (size_t bytes = 0; bytes <= codeword.size(); bytes += bytes < opening + 9 ? 7 : 401) {
      const Codewords cut = {codeword.first(bytes)};
      ASSERT_EQ(decodeTexture(encoded.header, cut, {}, {1, &memory}).samples,
                decodeTexture(encoded.header, cut).samples)
          << channels << " " << bytes;
    }
    EXPECT_TRUE(memory.opening.whole != nullptr);
  }
}

}  // namespace
}  // namespace tetrakis
