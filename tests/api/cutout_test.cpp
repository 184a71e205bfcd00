// SPDX-License-Identifier: Apache-2.0
// Cut-outs through the C interface: an alpha of two values comes first and exactly, colours that it
// hides cost nothing in lossy streams, and the reference decoder agrees on every prefix and level.
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::cutOut;
using samples::make;
using samples::Pattern;
using samples::Raster;
using samples::validity;
using samples::VoidShape;

struct Shape {
  uint32_t width, height, channels;
  tks_sample sample;
};

constexpr Shape kShapes[] = {{33, 20, 4, TKS_U8}, {1, 23, 2, TKS_U8}, {13, 18, 4, TKS_U16},
                             {5, 3, 2, TKS_U16},  {2, 1, 4, TKS_U8},  {40, 36, 2, TKS_U8},
                             {50, 5, 4, TKS_U8}};
constexpr VoidShape kMasks[] = {VoidShape::kCoast, VoidShape::kSpeckle, VoidShape::kOneValid};

Raster cutOutImage(const Shape& shape, VoidShape mask) {
  Raster image =
      make({Pattern::kRidges, shape.width, shape.height, shape.channels, shape.sample, 4});
  cutOut(image, validity(mask, shape.width, shape.height));
  return image;
}

bool hasBothAlphas(const Raster& image) {
  bool seen = false, hidden = false;
  for (size_t i = image.channels - 1; i * tks_sample_bytes(image.sample) < image.data.size();
       i += image.channels) {
    (sampleAt(image.data, image.sample, i) > 0 ? seen : hidden) = true;
  }
  return seen && hidden;
}

size_t wrongAlphas(const Raster& image, const std::vector<std::byte>& decoded) {
  size_t wrong = 0;
  const size_t samples = image.data.size() / tks_sample_bytes(image.sample);
  for (size_t i = image.channels - 1; i < samples; i += image.channels)
    wrong += sampleAt(image.data, image.sample, i) != sampleAt(decoded, image.sample, i);
  return wrong;
}

/// Mean squared error over alphas and the colours that are seen.
double meanSquare(const Raster& image, const std::vector<std::byte>& decoded) {
  double squares = 0, count = 0;
  const size_t samples = image.data.size() / tks_sample_bytes(image.sample);
  for (size_t i = 0; i < samples; ++i) {
    const size_t alpha = i - i % image.channels + image.channels - 1;
    if (i != alpha && sampleAt(image.data, image.sample, alpha) == 0) continue;
    squares +=
        std::pow(sampleAt(image.data, image.sample, i) - sampleAt(decoded, image.sample, i), 2);
    ++count;
  }
  return squares / count;
}

TEST(Cutout, LosslessRestoresHiddenColoursToo) {
  for (const Shape& shape : kShapes) {
    for (const VoidShape mask : kMasks) {
      const Raster image = cutOutImage(shape, mask);
      const Bytes bytes = encode(nullptr, &image, lossless());
      Stream stream(bytes);
      EXPECT_EQ(stream.info().texture_cutout, hasBothAlphas(image) ? 1 : 0);
      EXPECT_EQ(stream.info().lossless, 1);
      ASSERT_TRUE(sameBytes(stream.texture(), image.data)) << shape.width << "x" << shape.height;
    }
  }
}

TEST(Cutout, TheFirstBytesHoldTheShape) {
  const Raster image = cutOutImage({128, 120, 4, TKS_U8}, VoidShape::kCoast);
  const Bytes bytes = encode(nullptr, &image, budget(6000));
  const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  size_t exact = header;
  while (exact < bytes.size() && wrongAlphas(image, Stream(Prefix(bytes).first(exact)).texture()))
    exact += 20;
  EXPECT_LT(exact, header + 600);
  for (size_t n = exact; n <= bytes.size(); n += 300)
    ASSERT_EQ(wrongAlphas(image, Stream(Prefix(bytes).first(n)).texture()), 0u) << n;
}

/// Whatever is hidden: the same bytes, and one colour comes back for all of it.
TEST(Cutout, HiddenColoursCostNothing) {
  const Raster image = cutOutImage({70, 64, 4, TKS_U8}, VoidShape::kCoast);
  Raster other = image;
  for (size_t i = 0; i < other.data.size(); ++i) {
    if (i % 4 < 3 && image.data[i - i % 4 + 3] == std::byte{0})
      other.data[i] = static_cast<std::byte>(samples::hash(static_cast<uint32_t>(i), 1, 2));
  }
  const Bytes bytes = encode(nullptr, &image, budget(2500));
  EXPECT_EQ(bytes, encode(nullptr, &other, budget(2500)));
  Stream stream(bytes);
  EXPECT_EQ(stream.info().texture_cutout, 2);
  EXPECT_EQ(stream.info().lossless, 0);
  const std::vector<std::byte> decoded = stream.texture();
  std::vector<std::byte> fill;
  for (size_t i = 0; i < decoded.size(); i += 4) {
    if (decoded[i + 3] != std::byte{0}) continue;
    const std::vector<std::byte> colour(decoded.begin() + static_cast<ptrdiff_t>(i),
                                        decoded.begin() + static_cast<ptrdiff_t>(i + 3));
    if (fill.empty()) fill = colour;
    ASSERT_EQ(colour, fill);
  }
  EXPECT_FALSE(fill.empty());
}

TEST(Cutout, PsnrTargetsCountWhatIsSeen) {
  for (const VoidShape mask : {VoidShape::kCoast, VoidShape::kOneVoid}) {
    const Raster image = cutOutImage({90, 80, 4, TKS_U8}, mask);
    tks_encode_options options = {};
    options.size = sizeof options;
    options.psnr = 36;
    const Bytes bytes = encode(nullptr, &image, options);
    Stream stream(bytes);
    const double reached = 10 * std::log10(255 * 255 / meanSquare(image, stream.texture()));
    EXPECT_GE(reached, 36);
    EXPECT_LT(reached, 41);
    EXPECT_NEAR(stream.info().texture_psnr, reached, 1);  // stated in steps of 0.75 dB
  }
}

TEST(Cutout, QualityHardlyFallsFromPrefixToPrefix) {
  const Raster image = cutOutImage({22, 20, 4, TKS_U8}, VoidShape::kCoast);
  const double count = static_cast<double>(image.data.size());
  for (const tks_encode_options& options : {lossless(), budget(400)}) {
    const Bytes bytes = encode(nullptr, &image, options);
    const Stream whole(bytes);
    const bool hides = whole.info().texture_cutout == 2;
    ASSERT_EQ(hides, options.lossless == 0);
    double best = 1e9;
    for (size_t n = static_cast<size_t>(whole.info().header_bytes); n <= bytes.size(); ++n) {
      const std::vector<std::byte> decoded = Stream(Prefix(bytes).first(n)).texture();
      const double error =
          hides ? meanSquare(image, decoded) : squaredError(image, decoded) / count;
      ASSERT_LE(error, best * 1.00693 + 1e-9) << n;  // 0.03 dB
      best = std::min(best, error);
    }
  }
}

TEST(Cutout, OtherAlphasStayAComponent) {
  Raster image = cutOutImage({40, 33, 4, TKS_U8}, VoidShape::kCoast);
  image.data[3] = std::byte{254};
  const Bytes bytes = encode(nullptr, &image, lossless());
  Stream stream(bytes);
  EXPECT_EQ(stream.info().texture_cutout, 0);
  EXPECT_TRUE(sameBytes(stream.texture(), image.data));
}

/// One texel is half seen: alpha is a channel then. Colours where it is 0 are noise.
Raster softlyCutOut(uint32_t seed = 1) {
  Raster image = cutOutImage({90, 80, 4, TKS_U8}, VoidShape::kCoast);
  for (size_t i = 0; i < image.data.size(); ++i) {
    if (i % 4 < 3 && image.data[i - i % 4 + 3] == std::byte{0})
      image.data[i] = static_cast<std::byte>(samples::hash(static_cast<uint32_t>(i), seed, 2));
  }
  image.data[3] = std::byte{200};
  return image;
}

TEST(SoftAlpha, HiddenColoursCostNothingAndCountInNoError) {
  const Raster image = softlyCutOut(1), other = softlyCutOut(2);
  tks_encode_options to_quality = {};
  to_quality.size = sizeof to_quality;
  to_quality.psnr = 36;
  for (const tks_encode_options& options : {budget(2500), to_quality}) {
    const Bytes bytes = encode(nullptr, &image, options);
    EXPECT_EQ(bytes, encode(nullptr, &other, options));
    Stream stream(bytes);
    EXPECT_EQ(stream.info().texture_cutout, 0);
    EXPECT_EQ(stream.info().lossless, 0);
    const double reached = 10 * std::log10(255 * 255 / meanSquare(image, stream.texture()));
    if (options.psnr > 0) {
      EXPECT_GE(reached, 36);
      EXPECT_LT(reached, 40);
    }
    EXPECT_LE(stream.info().texture_psnr, reached + 0.1);
    EXPECT_GE(stream.info().texture_psnr, reached - 4);  // what is free has errors as well
  }
}

/// No stream is called lossless that has lost them.
TEST(SoftAlpha, LosslessRestoresHiddenColours) {
  const Raster image = softlyCutOut();
  const Bytes whole = encode(nullptr, &image, lossless());
  EXPECT_TRUE(sameBytes(Stream(whole).texture(), image.data));
  for (const double part : {0.5, 0.9, 1., 1.2, 2., 4.}) {
    const Bytes bytes = encode(
        nullptr, &image, budget(static_cast<uint64_t>(part * static_cast<double>(whole.size()))));
    Stream stream(bytes);
    const bool restored = stream.texture() == image.data;
    EXPECT_EQ(stream.info().lossless, restored ? 1 : 0) << part;
    if (part >= 2) {
      EXPECT_TRUE(restored) << part;
    }
  }
  tks_encode_options finest = {};
  finest.size = sizeof finest;
  finest.psnr = 90;
  Stream stream(encode(nullptr, &image, finest));
  EXPECT_EQ(stream.info().lossless, stream.texture() == image.data ? 1 : 0);
}

TEST(Cutout, NothingSeenCostsNothing) {
  const Raster image = cutOutImage({60, 50, 4, TKS_U8}, VoidShape::kAll);
  const Bytes whole = encode(nullptr, &image, lossless());
  EXPECT_TRUE(sameBytes(Stream(whole).texture(), image.data));
  const Bytes small = encode(nullptr, &image, budget(1000));
  EXPECT_LT(small.size(), 100u);
  EXPECT_EQ(Stream(small).info().texture_cutout, 2);
  EXPECT_EQ(wrongAlphas(image, Stream(small).texture()), 0u);
}

/// Lettering on a cut-out: the mask, then what is drawn.
TEST(Cutout, AnOverlayLeavesAlphasExact) {
  Raster image = make({Pattern::kRidges, 120, 100, 4, TKS_U8, 4});
  samples::drawOver(image, validity(VoidShape::kCoast, image.width, image.height));
  cutOut(image, validity(VoidShape::kFrame, image.width, image.height));
  for (const tks_encode_options& options : {lossless(), budget(3000)}) {
    const Bytes bytes = encode(nullptr, &image, options);
    Stream stream(bytes);
    EXPECT_TRUE(stream.info().texture_drawn == 2 && stream.info().texture_cutout);
    if (options.lossless) {
      EXPECT_TRUE(sameBytes(stream.texture(), image.data));
    }
    const auto header = static_cast<size_t>(stream.info().header_bytes);
    for (size_t n = header + 60; n <= bytes.size(); n += 97)
      ASSERT_EQ(wrongAlphas(image, Stream(Prefix(bytes).first(n)).texture()), 0u) << n;
  }
}

void expectAgreement(Prefix prefix, uint32_t level) {
  Stream stream(prefix);
  ASSERT_EQ(stream.status(), TKS_OK);
  ASSERT_EQ(tks_set_levels(stream.get(), 0, level), TKS_OK);
  tks_info info = stream.info();
  ASSERT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
  Bytes texture(size_t{info.texture_width} * info.texture_height * info.texture_channels *
                tks_sample_bytes(info.texture_sample));
  ASSERT_EQ(tks_decode_texture(stream.get(), texture.data(), texture.size()), TKS_OK);
  const auto decoded =
      reference::decode(prefix, reference::kMaxSamples, {0, static_cast<int>(level)});
  ASSERT_TRUE(decoded.texture.has_value());
  ASSERT_TRUE(texture == *decoded.texture) << "level " << level << ", " << prefix.size();
}

TEST(Cutout, LossyDrawingsLeaveAlphasExact) {
  Raster image = make({Pattern::kSteps, 80, 70, 4, TKS_U8, 4});
  cutOut(image, validity(VoidShape::kCoast, 80, 70));
  tks_encode_options psnr = budget(0);
  psnr.psnr = 30;
  const size_t drawn = encode(nullptr, &image, lossless()).size();
  for (const tks_encode_options& options : {psnr, budget(drawn / 2), budget(drawn * 3 / 4)}) {
    const Bytes bytes = encode(nullptr, &image, options);
    EXPECT_EQ(wrongAlphas(image, Stream(bytes).texture()), 0u) << bytes.size();
  }
}

TEST(Cutout, ReferenceDecoderAgrees) {
  for (const Shape& shape : kShapes) {
    for (const VoidShape mask : kMasks) {
      const Raster image = cutOutImage(shape, mask);
      if (!hasBothAlphas(image)) continue;
      for (tks_encode_options options : {lossless(), budget(300)}) {
        options.regions = mask == VoidShape::kCoast ? 16 : 1;
        const Bytes bytes = encode(nullptr, &image, options);
        const Stream stream(bytes);
        const auto header = static_cast<size_t>(stream.info().header_bytes);
        for (size_t part = 0; part <= 2; ++part) {
          const Prefix prefix = Prefix(bytes).first(header + (bytes.size() - header) * part / 2);
          const uint32_t coarsest = stream.info().texture_coarsest_level;
          for (const uint32_t level : {0u, std::min(2u, coarsest)})
            ASSERT_NO_FATAL_FAILURE(expectAgreement(prefix, level));
        }
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
