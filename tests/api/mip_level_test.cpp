// SPDX-License-Identifier: Apache-2.0
// Mip levels through the C interface: what they look like, that every prefix has them, and that the
// reference decoder makes the same bytes.
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

struct Images {
  std::vector<std::byte> heights, texture;
  tks_info info{};
};

/// Heights and texture of the levels, or as coarse as they come.
Images decodeLevels(Prefix prefix, uint32_t heights, uint32_t texture) {
  Stream stream(prefix);
  EXPECT_EQ(stream.status(), TKS_OK) << stream.message();
  Images images;
  images.info.size = sizeof images.info;
  EXPECT_EQ(tks_set_levels(stream.get(), std::min(heights, stream.info().coarsest_level),
                           std::min(texture, stream.info().texture_coarsest_level)),
            TKS_OK);
  tks_get_info(stream.get(), &images.info);
  const tks_info& info = images.info;
  images.heights.resize(size_t{info.width} * info.height * tks_sample_bytes(info.sample));
  images.texture.resize(size_t{info.texture_width} * info.texture_height * info.texture_channels *
                        tks_sample_bytes(info.texture_sample));
  if (info.has_heights) {
    EXPECT_EQ(tks_decode_heights(stream.get(), images.heights.data(), images.heights.size()),
              TKS_OK);
  }
  if (info.has_texture) {
    EXPECT_EQ(tks_decode_texture(stream.get(), images.texture.data(), images.texture.size()),
              TKS_OK);
  }
  return images;
}

void expectSame(const std::optional<Bytes>& expected, const std::vector<std::byte>& actual) {
  const Bytes none;
  const Bytes& bytes = expected ? *expected : none;
  ASSERT_EQ(bytes.size(), actual.size());
  ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), actual.begin(),
                         [](uint8_t a, std::byte b) { return a == std::to_integer<uint8_t>(b); }));
}

void expectAgreement(Prefix prefix, uint32_t level) {
  const Images images = decodeLevels(prefix, level, level);
  const int k = static_cast<int>(level);
  const reference::Decoded decoded = reference::decode(prefix, reference::kMaxSamples, {k, k});
  ASSERT_NO_FATAL_FAILURE(expectSame(decoded.heights, images.heights));
  ASSERT_NO_FATAL_FAILURE(expectSame(decoded.texture, images.texture));
}

void expectAgreementOnPrefixes(const Bytes& stream) {
  const Stream opened(stream);
  const auto header = static_cast<size_t>(opened.info().header_bytes);
  const uint32_t coarsest =
      std::max(opened.info().coarsest_level, opened.info().texture_coarsest_level);
  for (uint32_t level = 0; level <= coarsest; ++level) {
    for (size_t part = 0; part <= 3; ++part) {
      SCOPED_TRACE("level " + std::to_string(level) + ", part " + std::to_string(part));
      expectAgreement(Prefix(stream).first(header + (stream.size() - header) * part / 3), level);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{2, 2},   {3, 17}, {5, 40},
                                                    {17, 17}, {40, 9}, {37, 24}};

TEST(MipLevels, ReferenceDecoderAgreesOnEverySize) {
  for (const auto& [width, height] : kSizes) {
    for (tks_encode_options options : {lossless(), budget(900)}) {
      for (const uint32_t regions : {1u, 16u}) {
        SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
        options.regions = regions;
        const Raster heights = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
        const Raster image = make({Pattern::kRidges, height, width, 4, TKS_U8, 4});
        expectAgreementOnPrefixes(encode(&heights, &image, options));
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(MipLevels, ReferenceDecoderAgreesOnOverlays) {
  for (const uint32_t regions : {1u, 16u}) {
    Raster image = make({Pattern::kRidges, 61, 44, 3, TKS_U8, 4});
    samples::drawOver(image, samples::validity(samples::VoidShape::kCoast, 61, 44));
    tks_encode_options options = lossless();
    options.regions = regions;
    expectAgreementOnPrefixes(encode(nullptr, &image, options));
  }
}

TEST(MipLevels, ReferenceDecoderAgreesOnBridgedTextures) {
  for (const samples::VoidShape shape : {samples::VoidShape::kLines, samples::VoidShape::kHoles}) {
    Raster image = make({Pattern::kRidges, 61, 44, 4, TKS_U8, 4});
    samples::cutOut(image, samples::validity(shape, 61, 44));
    expectAgreementOnPrefixes(encode(nullptr, &image, budget(1500)));
  }
}

TEST(MipLevels, ReferenceDecoderAgreesOnDrawnTextures) {
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    const Raster image = make({Pattern::kSteps, width, height, 3, TKS_U8, 4});
    expectAgreementOnPrefixes(encode(nullptr, &image, lossless()));
    if (HasFatalFailure()) return;
  }
}

TEST(MipLevels, ReferenceDecoderAgreesOnVoidsAndCorrections) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    for (const bool exact : {false, true}) {
      SCOPED_TRACE(static_cast<int>(shape));
      Raster raster = make({Pattern::kRidges, 25, 18, 1, TKS_F32, 3});
      const auto valid = samples::validity(shape, 25, 18);
      for (size_t i = 0; i < valid.size(); ++i) {
        float sample = 0;
        std::memcpy(&sample, raster.data.data() + 4 * i, sizeof sample);
        sample = valid[i] ? sample / 3 : NAN;
        std::memcpy(raster.data.data() + 4 * i, &sample, sizeof sample);
      }
      expectAgreementOnPrefixes(encode(&raster, nullptr, exact ? lossless() : budget(700)));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(MipLevels, ExtremesStayInTheirType) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_U32}) {
    const Raster heights = make({Pattern::kExtreme, 30, 21, 1, sample, 3});
    expectAgreementOnPrefixes(encode(&heights, nullptr, lossless()));
    if (HasFatalFailure()) return;
  }
}

TEST(MipLevels, LevelZeroIsTheImage) {
  const Raster heights = make({Pattern::kRidges, 50, 41, 1, TKS_U16, 3});
  const Raster image = make({Pattern::kRidges, 41, 60, 3, TKS_U8, 4});
  const Bytes bytes = encode(&heights, &image, lossless());
  Stream stream(bytes);
  ASSERT_EQ(tks_set_levels(stream.get(), 2, 1), TKS_OK);
  std::vector<std::byte> small(13 * 11 * 2);
  EXPECT_EQ(tks_decode_heights(stream.get(), small.data(), small.size()), TKS_OK);
  ASSERT_EQ(tks_set_levels(stream.get(), 0, 0), TKS_OK);
  EXPECT_TRUE(sameBytes(stream.heights(), heights.data));
  EXPECT_TRUE(sameBytes(stream.texture(), image.data));
}

/// A smooth wave of `samples` per period, 8 bits, 3 channels.
Raster wave(uint32_t width, uint32_t height, double period, tks_sample sample, uint32_t channels) {
  Raster raster = make({Pattern::kFlat, width, height, channels, sample, 0});
  for (size_t i = 0; i < raster.data.size() / tks_sample_bytes(sample); ++i) {
    const size_t texel = i / channels;
    const double x = static_cast<double>(texel % width), y = static_cast<double>(texel / width);
    const double value =
        128 + 60 * std::sin(6.2832 * x / period) + 60 * std::cos(6.2832 * y / period);
    if (sample == TKS_U8) {
      raster.data[i] = static_cast<std::byte>(std::lround(value));
    } else {
      const auto word = static_cast<uint16_t>(std::lround(200 * value));
      std::memcpy(raster.data.data() + 2 * i, &word, sizeof word);
    }
  }
  return raster;
}

/// Peak signal to noise of a level against every 2^k-th sample of the raster, which is smooth.
double levelPsnr(const Raster& raster, const std::vector<std::byte>& level, uint32_t k,
                 double peak) {
  const uint32_t columns = ((raster.width - 1) >> k) + 1, rows = ((raster.height - 1) >> k) + 1;
  double squares = 0;
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns * raster.channels; ++x) {
      const size_t from =
          ((size_t{y} << k) * raster.width + (size_t{x / raster.channels} << k)) * raster.channels +
          x % raster.channels;
      squares +=
          std::pow(sampleAt(raster.data, raster.sample, from) -
                       sampleAt(level, raster.sample, size_t{y} * columns * raster.channels + x),
                   2);
    }
  }
  return 10 * std::log10(peak * peak * rows * columns * raster.channels / std::max(squares, 1e-3));
}

/// Gains and doublings are out: smooth images stay what they are, whatever the filters.
TEST(MipLevels, SmoothImagesKeepTheirValues) {
  const Raster heights = wave(300, 211, 150, TKS_U16, 1);
  const Raster image = wave(211, 300, 150, TKS_U8, 3);
  for (const tks_encode_options& options : {lossless(), budget(20000)}) {
    const Bytes stream = encode(&heights, &image, options);
    for (uint32_t k = 1; k <= 4; ++k) {
      const Images images = decodeLevels(stream, k, k);
      EXPECT_GT(levelPsnr(heights, images.heights, k, 200 * 255), 38) << k;
      EXPECT_GT(levelPsnr(image, images.texture, k, 255), 38) << k;
    }
  }
}

TEST(MipLevels, ConstantsAreExactAtEveryLevel) {
  const Raster heights = make({Pattern::kFlat, 77, 130, 1, TKS_I16});
  const Raster image = make({Pattern::kFlat, 90, 33, 4, TKS_U8});
  const Bytes stream = encode(&heights, &image, lossless());
  for (uint32_t k = 0; k <= 6; ++k) {
    const Images images = decodeLevels(stream, k, k);
    ASSERT_TRUE(sameBytes(images.heights, std::span(heights.data).first(images.heights.size())));
    ASSERT_TRUE(sameBytes(images.texture, std::span(image.data).first(images.texture.size())));
  }
}

TEST(MipLevels, MoreBytesMakeBetterLevels) {
  const Raster image = wave(256, 256, 40, TKS_U8, 3);
  const Bytes stream = encode(nullptr, &image, lossless());
  for (const uint32_t k : {1u, 2u}) {
    const std::vector<std::byte> whole = decodeLevels(stream, 0, k).texture;
    const auto errorAt = [&](size_t bytes) {
      const std::vector<std::byte> part = decodeLevels(Prefix(stream).first(bytes), 0, k).texture;
      double squares = 0;
      for (size_t i = 0; i < whole.size(); ++i)
        squares += std::pow(std::to_integer<int>(whole[i]) - std::to_integer<int>(part[i]), 2);
      return squares;
    };
    EXPECT_LT(errorAt(stream.size() / 4), errorAt(stream.size() / 16));
    EXPECT_LT(errorAt(stream.size() / 16), errorAt(200));
  }
}

TEST(MipLevels, InfoTellsTheirSizesAndSpacing) {
  Raster raster = make({Pattern::kRidges, 97, 41, 1, TKS_U16, 3});
  tks_heights heights = raster.heights();
  heights.spacing_x = 30;
  heights.spacing_y = 25;
  const Images images = decodeLevels(encodeHeights(heights, lossless()), 3, 0);
  EXPECT_EQ(images.info.width, 13u);
  EXPECT_EQ(images.info.height, 6u);
  EXPECT_EQ(images.info.spacing_x, 240);
  EXPECT_EQ(images.info.spacing_y, 200);
}

TEST(MipLevels, RefusesWhatThereIsNot) {
  const Raster heights = make({Pattern::kRidges, 33, 20, 1, TKS_U16, 3});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  Stream stream(bytes);
  EXPECT_EQ(stream.info().coarsest_level, 4u);
  EXPECT_EQ(stream.info().texture_coarsest_level, 0u);
  EXPECT_EQ(tks_set_levels(stream.get(), 5, 0), TKS_USAGE);
  EXPECT_STREQ(tks_message(stream.get()), "The heights have no level 5; their coarsest is 4.");
  EXPECT_EQ(tks_set_levels(stream.get(), 0, 1), TKS_USAGE);
  EXPECT_STREQ(tks_message(stream.get()), "The stream holds no texture.");
  EXPECT_TRUE(sameBytes(stream.heights(), heights.data));
  ASSERT_EQ(tks_set_levels(stream.get(), 1, 0), TKS_OK);
  tks_mesh mesh;
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 100, &mesh), TKS_USAGE);
  std::vector<std::byte> whole(33 * 20 * 2);
  EXPECT_EQ(tks_decode_heights(stream.get(), whole.data(), whole.size()), TKS_USAGE);
  const Raster image = make({Pattern::kRidges, 33, 20, 1, TKS_U8, 3});
  const Bytes texels = encode(nullptr, &image, lossless());
  Stream picture(texels);
  EXPECT_EQ(tks_set_levels(picture.get(), 1, 0), TKS_USAGE);
  EXPECT_STREQ(tks_message(picture.get()), "The stream holds no heights.");
  EXPECT_EQ(tks_set_levels(picture.get(), 0, 1), TKS_OK);
}

}  // namespace
}  // namespace tetrakis::test
