// SPDX-License-Identifier: Apache-2.0
// Drawn textures: lossless ends, prefixes, when they are chosen, hostile codewords.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bitstream/stream/fields.hpp"
#include "tests/support/texel_errors.hpp"
#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis {
namespace {

struct Size {
  uint32_t width, height;
};

constexpr Size kSizes[] = {{1, 1}, {2, 1}, {1, 9}, {2, 2}, {5, 3}, {33, 33}, {64, 17}, {3, 1000}};

/// Rectangles one over the other in `colours` random colours.
Texels drawing(Size size, uint32_t channels, int bits, uint32_t colours, uint32_t seed = 1) {
  std::mt19937 random(seed);
  Texels texels{size.width, size.height, channels, bits, {}};
  texels.samples.resize(size_t{size.width} * size.height * channels);
  std::vector<std::vector<uint16_t>> list(colours, std::vector<uint16_t>(channels));
  for (auto& colour : list) {
    for (uint16_t& value : colour) value = static_cast<uint16_t>(random() % (1u << bits));
  }
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random()) % n; };
  for (uint32_t i = 0; i < 4 * colours; ++i) {
    const auto& colour = list[i % colours];
    const bool all = i == 0;
    const uint32_t x0 = all ? 0 : below(size.width), y0 = all ? 0 : below(size.height);
    const uint32_t x1 = all ? size.width : std::min(size.width, x0 + 1 + below(20));
    const uint32_t y1 = all ? size.height : std::min(size.height, y0 + 1 + below(20));
    for (uint32_t y = y0; y < y1; ++y) {
      for (uint32_t x = x0; x < x1; ++x) {
        std::copy(colour.begin(), colour.end(),
                  texels.samples.begin() +
                      static_cast<ptrdiff_t>((size_t{y} * size.width + x) * channels));
      }
    }
  }
  return texels;
}

/// Every texel another colour than its neighbours, of 2^colour_bits.
Texels noise(Size size, uint32_t channels, int colour_bits) {
  std::mt19937 random(3);
  Texels texels{size.width, size.height, channels, 8, {}};
  for (size_t i = 0; i < size_t{size.width} * size.height * channels; ++i)
    texels.samples.push_back(static_cast<uint16_t>((random() % (1u << colour_bits)) * 3));
  return texels;
}

std::span<const uint8_t> prefixOf(const EncodedTexture& encoded, size_t bytes) {
  return std::span(encoded.tracks.front().codeword).first(bytes);
}

TEST(Drawn, IsLosslessAtItsEnd) {
  for (const Size& size : kSizes) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const int bits : {8, 16}) {
        for (const uint32_t colours : {1u, 2u, 60u}) {
          const Texels texels = drawing(size, channels, bits, colours);
          const auto encoded = encodeDrawn(texels);
          if (!encoded) continue;  // too small for texels to be alike
          EXPECT_TRUE(encoded->header.drawn());
          EXPECT_EQ(decodeTexture(encoded->header, {encoded->tracks.front().codeword}).samples,
                    texels.samples)
              << size.width << " x " << size.height << " x " << channels << ", " << bits << " bits";
        }
      }
    }
  }
}

TEST(Drawn, AThousandColoursComeBack) {
  const Texels texels = drawing({300, 200}, 3, 8, 1500);
  const auto encoded = encodeDrawn(texels);
  ASSERT_TRUE(encoded);
  EXPECT_EQ(decodeTexture(encoded->header, {encoded->tracks.front().codeword}).samples,
            texels.samples);
  EXPECT_LT(encoded->tracks.front().codeword.size(), texels.samples.size() / 6);
}

/// What a prefix shows is about what the stated points say: it may know a few vertices of the next
/// level, too, and they may mislead the texels around them.
TEST(Drawn, PointsAreTrue) {
  const Texels texels = drawing({90, 70}, 3, 8, 12);
  const auto encoded = encodeDrawn(texels);
  ASSERT_TRUE(encoded);
  const std::vector<RatePoint>& points = encoded->tracks.front().points;
  ASSERT_GT(points.size(), 4u);
  for (size_t i = 0; i < points.size(); ++i) {
    const Texels decoded = decodeTexture(encoded->header, {prefixOf(*encoded, points[i].bytes)});
    EXPECT_LE(squaredError(decoded, texels), 1.15 * points[i].distortion);
    if (i == 0) continue;
    EXPECT_GT(points[i].bytes, points[i - 1].bytes);
    EXPECT_LT(points[i].distortion, points[i - 1].distortion);
  }
  EXPECT_EQ(points.back().distortion, 0);
}

TEST(Drawn, EveryPrefixDecodesAndTexelsStay) {
  const Texels texels = drawing({41, 30}, 2, 16, 9);
  const auto encoded = encodeDrawn(texels);
  ASSERT_TRUE(encoded);
  size_t known_before = 0;
  for (size_t bytes = 0; bytes <= encoded->tracks.front().codeword.size(); ++bytes) {
    const Texels decoded = decodeTexture(encoded->header, {prefixOf(*encoded, bytes)});
    size_t right = 0;
    for (size_t i = 0; i < texels.samples.size(); ++i)
      right += decoded.samples[i] == texels.samples[i];
    // Texels that were guessed rightly may be lost again, those that were decoded may not.
    EXPECT_GE(right + texels.samples.size() / 8, known_before) << bytes;
    known_before = std::max(known_before, right);
  }
  EXPECT_EQ(known_before, texels.samples.size());
}

TEST(Drawn, AnyBytesDecode) {
  const Texels texels = drawing({50, 40}, 3, 8, 30);
  const auto encoded = encodeDrawn(texels);
  ASSERT_TRUE(encoded);
  std::mt19937 random(9);
  for (size_t at = 0; at < encoded->tracks.front().codeword.size(); ++at) {
    std::vector<uint8_t> damaged = encoded->tracks.front().codeword;
    damaged[at] = static_cast<uint8_t>(damaged[at] ^ (1 + random() % 255));
    EXPECT_EQ(decodeTexture(encoded->header, {damaged}).samples.size(), texels.samples.size());
  }
  std::vector<uint8_t> wild(3000);
  for (int round = 0; round < 20; ++round) {
    for (uint8_t& byte : wild)
      byte = static_cast<uint8_t>(round == 0 ? 0 : round == 1 ? 255 : random());
    EXPECT_EQ(decodeTexture(encoded->header, {wild}).samples.size(), texels.samples.size());
  }
}

TEST(Drawn, NoiseAndTooManyColoursAreNot) {
  EXPECT_FALSE(encodeDrawn(noise({60, 60}, 1, 6)));
  Texels many{128, 256, 3, 8, {}};
  for (uint32_t i = 0; i < 128 * 256; ++i) {  // pairs of texels alike, more colours than indices
    const uint32_t colour = i / 2;
    for (const uint32_t shift : {0u, 5u, 10u})
      many.samples.push_back(static_cast<uint16_t>((colour >> shift) % 32));
  }
  EXPECT_FALSE(encodeDrawn(many));
}

/// A photograph with water of one colour, alike enough to be tried as a drawing.
Texels lakeInPhotograph() {
  Texels lake{200, 150, 1, 8, {}};
  std::mt19937 random(4);
  for (uint32_t i = 0; i < 200 * 150; ++i) {
    const double wave = 120 + 60 * std::sin(0.05 * (i % 200)) * std::cos(0.07 * (i / 200));
    const double land = wave + static_cast<double>(random() % 6);
    lake.samples.push_back(i % 200 < 120 ? uint16_t{40} : static_cast<uint16_t>(land));
  }
  return lake;
}

TEST(Drawn, IsChosenForDrawingsAndNotForLakesInPhotographs) {
  const Texels map = drawing({200, 150}, 3, 8, 10), lake = lakeInPhotograph();
  ASSERT_TRUE(encodeDrawn(lake)) << "alike enough to be tried";
  for (const Purpose purpose : {Purpose::kLossless, Purpose::kLossy}) {
    EXPECT_TRUE(encodeTexture(map, purpose, {}).header.drawn());
    EXPECT_FALSE(encodeTexture(lake, purpose, {}).header.drawn());
  }
}

/// Few colours without runs: a dithered wave, noise of four greys, a wave of 60 colours with grain.
std::vector<Texels> fewColours() {
  Texels dithered{160, 120, 1, 8, {}}, noisy = dithered, grainy{160, 120, 3, 8, {}};
  constexpr std::array<int, 16> kBayer = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  std::mt19937 random(6);
  for (uint32_t i = 0; i < 160 * 120; ++i) {
    const uint32_t x = i % 160, y = i / 160;
    const double wave = 0.5 + 0.4 * std::sin(0.05 * x) * std::cos(0.07 * y);
    dithered.samples.push_back(16 * wave > kBayer[y % 4 * 4 + x % 4] ? 255 : 0);
    noisy.samples.push_back(static_cast<uint16_t>(80 * (random() % 4)));
    const auto colour = static_cast<uint32_t>(56 * wave) + static_cast<uint32_t>(random() % 4);
    for (const uint32_t factor : {1u, 13u, 29u})
      grainy.samples.push_back(static_cast<uint16_t>(colour * factor % 64 * 4));
  }
  return {dithered, noisy, grainy};
}

/// What the wavelet and its overlays make of it at their best.
size_t waveletBytes(const Texels& texels) {
  size_t bytes = bytesOf(encodeByWavelet(texels, Purpose::kLossless, {}).tracks);
  const std::vector<uint8_t> photograph = photographOf(texels);
  if (photograph.empty()) return bytes;
  return std::min(bytes,
                  bytesOf(encodeByWavelet(texels, Purpose::kLossless, {}, photograph).tracks));
}

TEST(Drawn, FewColoursAreTriedWhateverTheirNeighbours) {
  for (const Texels& texels : fewColours()) {
    EXPECT_FALSE(encodeDrawn(texels)) << "not alike";
    const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
    EXPECT_TRUE(encoded.header.drawn());
    EXPECT_LT(bytesOf(encoded.tracks), waveletBytes(texels) / 2);
    TextureOptions budget{.limit = 40000, .room = 20000}, psnr{.mean_square = 1};
    EXPECT_TRUE(encodeTexture(texels, Purpose::kLossy, budget).header.drawn()) << "fits whole";
    EXPECT_TRUE(encodeTexture(texels, Purpose::kLossy, psnr).header.drawn());
    budget.room = bytesOf(encoded.tracks) / 4;
    EXPECT_FALSE(encodeTexture(texels, Purpose::kLossy, budget).header.drawn());
  }
}

/// Steep ground with its flats in one value, whose borders are ragged.
Texels flats() {
  Texels texels{240, 180, 1, 8, {}};
  std::mt19937 random(8);
  for (uint32_t i = 0; i < 240 * 180; ++i) {
    const uint32_t x = i % 240, y = i / 240;
    const double wave = std::sin(0.09 * x + 0.03 * y) * std::cos(0.08 * y);
    const bool flat = wave < 0.1 + 0.0005 * static_cast<double>(random() % 100);
    const double slope = 60 + 170 * wave + static_cast<double>(random() % 20);
    texels.samples.push_back(flat ? uint16_t{0} : static_cast<uint16_t>(slope));
  }
  return texels;
}

TEST(Drawn, LosesToAnOverlayOverThePhotograph) {
  const Texels texels = flats();
  const auto drawn = encodeDrawn(texels);
  ASSERT_TRUE(drawn);
  const EncodedTexture plain = encodeByWavelet(texels, Purpose::kLossless, {});
  ASSERT_LT(bytesOf(drawn->tracks), bytesOf(plain.tracks)) << "better than the wavelet alone";
  const EncodedTexture encoded = encodeTexture(texels, Purpose::kLossless, {});
  EXPECT_GT(encoded.header.overlay_bytes, 0u);
  EXPECT_LT(bytesOf(encoded.tracks), bytesOf(drawn->tracks));
  EXPECT_EQ(decodeTexture(encoded.header, {encoded.tracks.front().codeword}).samples,
            texels.samples);
}

/// A grainy slope in pairs of texels alike. Every colour is as frequent as any other, so that none
/// fills enough for an overlay.
Texels slopeOfPairs() {
  constexpr size_t kPairs = 100 * 150, kColours = 4000;
  std::mt19937 random(5);
  std::vector<std::pair<size_t, size_t>> heights(kPairs);  // and whose they are
  for (size_t i = 0; i < kPairs; ++i)
    heights[i] = {23 * (i % 100) + 11 * (i / 100) + random() % 40, i};
  std::sort(heights.begin(), heights.end());
  Texels slope{200, 150, 1, 16, std::vector<uint16_t>(2 * kPairs)};
  for (size_t rank = 0; rank < kPairs; ++rank) {
    const size_t at = 2 * heights[rank].second;
    slope.samples[at] = slope.samples[at + 1] = static_cast<uint16_t>(rank * kColours / kPairs);
  }
  return slope;
}

std::vector<uint8_t> fieldsOf(TextureHeader header) {
  FieldWriter writer;
  header.visit(writer, header.shown());
  writer.put(header.regions.side_log2);
  return writer.bytes;
}

/// What the wavelet made of an image to judge a drawing or an overlay serves instead of coding the
/// image again, but only where that gives the same.
void expectTheWaveletsOwn(const TextureSource& source, Purpose purpose,
                          const TextureOptions& options) {
  const EncodedTexture chosen = encodeTexture(source, purpose, options);
  if (chosen.header.direct()) return;
  std::vector<uint8_t> photograph;
  if (chosen.header.overlay_bytes > 0) photograph = photographOf(source.texels);
  const EncodedTexture alone = encodeByWavelet(source, purpose, options, photograph);
  EXPECT_EQ(fieldsOf(chosen.header), fieldsOf(alone.header));
  EXPECT_EQ(chosen.header.weights.levels, alone.header.weights.levels);
  ASSERT_EQ(chosen.tracks.size(), alone.tracks.size());
  for (size_t i = 0; i < chosen.tracks.size(); ++i)
    EXPECT_EQ(chosen.tracks[i].codeword, alone.tracks[i].codeword);
}

TEST(Drawn, LosesToWhatTheWaveletMakesAlone) {
  const TextureSource lake = lakeInPhotograph(), slope = slopeOfPairs();
  ASSERT_TRUE(encodeDrawn(lake.texels) && encodeDrawn(slope.texels)) << "tried";
  ASSERT_TRUE(!photographOf(lake.texels).empty() && photographOf(slope.texels).empty());
  EXPECT_FALSE(encodeTexture(slope, Purpose::kLossless, {}).header.direct());
  for (const TextureSource* source : {&lake, &slope}) {
    for (const int regions : {0, 5}) {
      for (const bool visual : {false, true}) {
        const TextureOptions all{.region_log2 = regions, .visual = visual};
        TextureOptions budget = all;
        budget.room = 2000;
        budget.limit = 2 * budget.room;
        expectTheWaveletsOwn(*source, Purpose::kLossless, all);
        expectTheWaveletsOwn(*source, Purpose::kLossy, all);
        expectTheWaveletsOwn(*source, Purpose::kLossy, budget);
        for (const double error : {0.02, 0.3, 3.0}) {
          TextureOptions target = all;
          target.mean_square = error;
          expectTheWaveletsOwn(*source, Purpose::kLossy, target);
        }
      }
    }
  }
}

/// What encoders find out about all prefixes at once is what a decoder shows of each.
TEST(DrawnTexture, PrefixesOfEncodersAreWhatDecodersShow) {
  for (const Size size : {Size{1, 1}, {1, 50}, {21, 17}, {32, 3}}) {
    for (const uint32_t channels : {1u, 4u}) {
      const Texels texels = drawing(size, channels, 8, 20);
      const auto encoded = encodeDrawn(texels, 1 << 20);
      ASSERT_TRUE(encoded);
      const std::span<const uint8_t> codeword = encoded->tracks.front().codeword;
      const auto shown = prefixesOfDrawing(encoded->header, codeword);
      for (uint64_t bytes = 0; bytes <= codeword.size(); ++bytes)
        ASSERT_EQ(shown(bytes).samples,
                  decodeDrawn(encoded->header, codeword.first(bytes), {}).samples)
            << bytes;
      std::vector<uint8_t> photograph(texels.extent().samples());
      for (size_t i = 0; i < photograph.size(); ++i) photograph[i] = i % 5 == 1;
      const std::vector<uint8_t> overlay = encodeOverlay(texels, photograph);
      const auto over = prefixesOfOverlay(encoded->header, overlay);
      for (uint64_t bytes = 0; bytes <= overlay.size(); ++bytes) {
        const auto prefix = std::span<const uint8_t>(overlay).first(bytes);
        const DrawnOverlay decoded = decodeOverlay(encoded->header, prefix);
        const DrawnOverlay expected = over(bytes);
        for (size_t i = 0; i < photograph.size(); ++i)
          ASSERT_EQ(DrawnIndex{expected.indices[i]}, DrawnIndex{decoded.indices[i]}) << bytes;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis
