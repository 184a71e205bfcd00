// SPDX-License-Identifier: Apache-2.0
// Bridges over texels that are hidden or drawn over: only bytes depend on what stands there.
#include "texture_wavelet/colour_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "conformance/samples/void_masks.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::test {
namespace {

using samples::VoidShape;

constexpr VoidShape kShapes[] = {VoidShape::kLines, VoidShape::kHoles, VoidShape::kSpeckle,
                                 VoidShape::kFrame};
constexpr uint8_t kReaches[] = {0, 1, 3, 255};

/// A smooth image with a little noise.
Texels picture(Extent extent, uint32_t channels, int bits) {
  std::mt19937 random(channels);
  Texels texels{extent.width, extent.height, channels, bits, {}};
  for (uint32_t i = 0; i < extent.samples(); ++i) {
    const uint32_t x = i % extent.width, y = i / extent.width;
    const uint32_t smooth = samples::valueNoise(x, y, 5, 3);
    for (uint32_t c = 0; c < channels; ++c)
      texels.samples.push_back(
          static_cast<uint16_t>((smooth + random() % 1500) >> (bits == 8 ? 8 : 0)));
  }
  for (uint16_t& sample : texels.samples) sample = std::min(sample, texels.most());
  return texels;
}

/// Codes with bridges of that reach.
EncodedTexture coded(const TextureSource& source, Purpose purpose, Mask photograph, uint8_t reach) {
  TextureHeader like = encodeByWavelet(source, purpose, {}, photograph).header;
  like.bridge = reach;
  return encodeByWavelet(source, purpose, {}, photograph, &like);
}

TEST(TextureBridges, LosslessComesBackWhateverTheirReach) {
  for (const Extent extent : {Extent{64, 50}, {1, 70}, {33, 2}}) {
    for (const VoidShape shape : kShapes) {
      for (const uint32_t channels : {1u, 3u, 4u}) {
        const Texels texels = picture(extent, channels, channels == 1 ? 16 : 8);
        const std::vector<uint8_t> mask = samples::validity(shape, extent.width, extent.height);
        Texels lines = texels;
        for (size_t i = 0; i < mask.size(); ++i) {
          if (!mask[i]) std::fill_n(lines.samples.begin() + i * channels, channels, uint16_t{255});
        }
        for (const uint8_t reach : kReaches) {
          const EncodedTexture encoded = coded(lines, Purpose::kLossless, mask, reach);
          ASSERT_EQ(encoded.header.bridge, reach);
          const Codewords codewords = {encoded.tracks.front().codeword};
          ASSERT_EQ(decodeTexture(encoded.header, codewords).samples, lines.samples)
              << shape << ", " << channels << " channels, reach " << int{reach};
        }
      }
    }
  }
}

/// The account counts texels that are seen, which are fewer than those that are coded. In the
/// middle of wide voids there is nothing to be off by: bridges are not chosen there.
TEST(TextureBridges, AccountsTellTheErrorOfWhatIsSeen) {
  const Extent extent{160, 120};
  for (const VoidShape shape : kShapes) {
    Texels texels = picture(extent, 4, 8);
    const std::vector<uint8_t> mask = samples::validity(shape, extent.width, extent.height);
    for (size_t i = 0; i < mask.size(); ++i)
      texels.samples[4 * i + 3] = mask[i] ? uint16_t{255} : uint16_t{0};
    const TextureSource source(texels);
    for (const uint8_t reach : {uint8_t{0}, uint8_t{1}, uint8_t{3}}) {
      const EncodedTexture encoded = coded(source, Purpose::kLossy, {}, reach);
      const EncodedTrack& track = encoded.tracks.front();
      const auto point =
          std::find_if(track.points.begin(), track.points.end(),
                       [&](const RatePoint& p) { return p.bytes > track.codeword.size() / 8; });
      const std::span<const uint8_t> codeword = track.codeword;
      const Texels shown =
          decodeTexture(encoded.header, {codeword.first(static_cast<size_t>(point->bytes))});
      const double squares = countedSquares(texels, shown, source.coloured(true));
      EXPECT_NEAR(point->distortion / squares, 1, 0.25) << shape << ", reach " << int{reach};
    }
  }
}

TEST(TextureBridges, GrowInOneMemoryAsAlone) {
  Texels texels = picture({90, 60}, 4, 8);
  const std::vector<uint8_t> mask = samples::validity(VoidShape::kHoles, 90, 60);
  for (size_t i = 0; i < mask.size(); ++i)
    texels.samples[4 * i + 3] = mask[i] ? uint16_t{255} : uint16_t{0};
  for (const uint8_t reach : kReaches) {
    const EncodedTexture encoded = coded(texels, Purpose::kLossy, {}, reach);
    const std::span<const uint8_t> codeword = encoded.tracks.front().codeword;
    const auto opening = static_cast<size_t>(encoded.header.alpha_bytes);
    TextureMemory memory;
    for (size_t bytes = 0; bytes <= codeword.size(); bytes += bytes < opening + 9 ? 7 : 401) {
      const Codewords cut = {codeword.first(bytes)};
      ASSERT_EQ(decodeTexture(encoded.header, cut, {}, {1, &memory}).samples,
                decodeTexture(encoded.header, cut).samples)
          << int{reach} << ", " << bytes;
    }
    EXPECT_GE(memory.bytes(), mask.size());
  }
}

TEST(TextureBridges, AreChosenOverLinesForABudget) {
  const Extent extent{200, 150};
  Texels texels = picture(extent, 3, 8);
  std::vector<std::vector<int32_t>> planes(3, std::vector<int32_t>(extent.samples()));
  for (size_t i = 0; i < texels.samples.size(); ++i) planes[i % 3][i / 3] = texels.samples[i];
  const std::vector<uint8_t> lines = samples::validity(VoidShape::kLines, 200, 150);
  const std::vector<uint8_t> half = samples::validity(VoidShape::kHalf, 200, 150);
  const BridgeTarget target{Purpose::kLossy, 2000};
  const auto chosen = [&](Mask coded) {
    return chooseTextureBridges({extent, coded, planes}, 8, target);
  };
  const TextureBridges bridges = chosen(lines);
  EXPECT_GT(bridges.reach, 0);
  EXPECT_TRUE(bridges.lifting(lines).all());
  EXPECT_LT(bridges.share, 1);
  EXPECT_EQ(chosen(half).reach, 0);
  EXPECT_EQ(chosen({}).reach, 0);
}

}  // namespace
}  // namespace tetrakis::test
