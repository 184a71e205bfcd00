// SPDX-License-Identifier: Apache-2.0
// Whole streams: a lossless stream restores every sample of every type and size, with its metadata.
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr tks_sample kHeightTypes[] = {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32};
constexpr Pattern kPatterns[] = {Pattern::kFlat,  Pattern::kRamp,    Pattern::kRidges,
                                 Pattern::kSteps, Pattern::kChecker, Pattern::kExtreme};

void expectRoundTrip(const Raster* heights, const Raster* image) {
  const Bytes bytes = encode(heights, image, lossless());
  ASSERT_FALSE(bytes.empty());
  Stream stream(bytes);
  ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
  EXPECT_EQ(stream.info().stream_bytes, bytes.size());
  EXPECT_TRUE(stream.info().lossless);
  EXPECT_EQ(stream.info().has_heights != 0, heights != nullptr);
  EXPECT_EQ(stream.info().has_texture != 0, image != nullptr);
  EXPECT_TRUE(!heights || stream.heights() == heights->data);
  EXPECT_TRUE(!image || stream.texture() == image->data);
  EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
}

std::string label(const samples::Recipe& r) {
  return "pattern " + std::to_string(int(r.pattern)) + ", " + std::to_string(r.width) + "x" +
         std::to_string(r.height) + "x" + std::to_string(r.channels) + ", sample type " +
         std::to_string(int(r.sample));
}

// The first failure of a test is enough: the others of its loop say the same.
void expectHeightsRoundTrip(const samples::Recipe& recipe) {
  if (::testing::Test::HasFailure()) return;
  SCOPED_TRACE(label(recipe));
  const Raster heights = make(recipe);
  expectRoundTrip(&heights, nullptr);
}

void expectImageRoundTrip(const samples::Recipe& recipe) {
  if (::testing::Test::HasFailure()) return;
  SCOPED_TRACE(label(recipe));
  const Raster image = make(recipe);
  expectRoundTrip(nullptr, &image);
}

TEST(StreamRoundTrip, HeightsOfEveryTypeAndPattern) {
  for (const tks_sample sample : kHeightTypes) {
    for (const Pattern pattern : kPatterns) {
      expectHeightsRoundTrip({pattern, 2, 2, 1, sample});
      expectHeightsRoundTrip({pattern, 17, 12, 1, sample});
    }
  }
}

/// Every width and every height from 1 to 40 once: 17 and 40 have no common divisor.
TEST(StreamRoundTrip, HeightsOfManySizes) {
  for (uint32_t width = 1; width <= 24; ++width) {
    const uint32_t height = 1 + width * 17 % 24;
    expectHeightsRoundTrip({Pattern::kRidges, width, height, 1, kHeightTypes[width % 7]});
  }
}

TEST(StreamRoundTrip, LongAndLargeHeights) {
  expectHeightsRoundTrip({Pattern::kRidges, 300, 200, 1, TKS_U16});
  expectHeightsRoundTrip({Pattern::kRidges, 3, 1000, 1, TKS_I16});
  expectHeightsRoundTrip({Pattern::kRidges, 1000, 2, 1, TKS_F32});
}

TEST(StreamRoundTrip, ImagesOfEveryTypeAndPattern) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const Pattern pattern : kPatterns) {
        expectImageRoundTrip({pattern, 1, 1, channels, sample});
        expectImageRoundTrip({pattern, 11, 9, channels, sample});
      }
    }
  }
}

/// Every width and every height from 1 to 24 once: 17 and 24 have no common divisor.
TEST(StreamRoundTrip, ImagesOfManySizes) {
  for (uint32_t width = 1; width <= 24; ++width) {
    const uint32_t height = 1 + width * 17 % 24;
    expectImageRoundTrip({Pattern::kRidges, width, height, 1 + width % 4, TKS_U8});
  }
}

TEST(StreamRoundTrip, LongAndLargeImages) {
  expectImageRoundTrip({Pattern::kRidges, 1, 1000, 3, TKS_U8});
  expectImageRoundTrip({Pattern::kRidges, 300, 200, 3, TKS_U8});
}

TEST(StreamRoundTrip, HeightsAndImageTogether) {
  const Raster heights = make({Pattern::kRidges, 33, 29, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 50, 44, 3, TKS_U8});
  expectRoundTrip(&heights, &image);
}

TEST(StreamRoundTrip, MetadataComesBack) {
  const Raster raster = make({Pattern::kRidges, 9, 7, 1, TKS_I16});
  tks_heights heights = raster.heights();
  heights.scale = 0.25;
  heights.offset = -431.5;
  heights.spacing_x = 30.5;
  heights.spacing_y = 29.75;
  heights.unit = "m";
  heights.vertical_datum = "EGM2008";
  heights.crs = "EPSG:32633";
  tks_encode_options options = lossless();
  options.triangles = 77;
  const Bytes bytes = encodeHeights(heights, options);
  Stream stream(bytes);
  EXPECT_EQ(stream.info().width, 9u);
  EXPECT_EQ(stream.info().height, 7u);
  EXPECT_EQ(stream.info().sample, TKS_I16);
  EXPECT_EQ(stream.info().scale, 0.25);
  EXPECT_EQ(stream.info().offset, -431.5);
  EXPECT_EQ(stream.info().spacing_x, 30.5);
  EXPECT_EQ(stream.info().spacing_y, 29.75);
  EXPECT_EQ(stream.info().triangles, 77u);
  EXPECT_STREQ(stream.info().unit, "m");
  EXPECT_STREQ(stream.info().vertical_datum, "EGM2008");
  EXPECT_STREQ(stream.info().crs, "EPSG:32633");
}

/// The front index tells where packets are; it must not change what they hold.
TEST(StreamRoundTrip, IndexedStreamDecodesTheSame) {
  const Raster heights = make({Pattern::kRidges, 33, 29, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 50, 44, 3, TKS_U8});
  tks_encode_options options = lossless();
  options.index = 1;
  const Bytes indexed = encode(&heights, &image, options);
  const Bytes plain = encode(&heights, &image, lossless());
  EXPECT_GT(indexed.size(), plain.size());
  Stream stream(indexed);
  EXPECT_TRUE(stream.heights() == heights.data);
  EXPECT_TRUE(stream.texture() == image.data);
}

/// The index informs: a quality that is not its own is damage only where a checksum says so.
TEST(StreamRoundTrip, VerifyDoesNotHoldTheIndexAgainstThePackets) {
  const Raster heights = make({Pattern::kRidges, 33, 29, 1, TKS_I16});
  tks_encode_options options = lossless();
  options.index = 1;
  for (const uint64_t budget : {0, 400}) {
    options.bytes = budget;
    options.lossless = budget == 0;
    Bytes bytes = encode(&heights, nullptr, options);
    size_t quality = 0;
    {
      Stream stream(bytes);
      EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
      quality = static_cast<size_t>(stream.info().header_bytes);
    }
    while (bytes[quality] >= 0x80) ++quality;  // the head's varint
    bytes[quality + 1] ^= 1;
    Stream tampered(bytes);
    EXPECT_EQ(tks_verify(tampered.get()), budget == 0 ? TKS_CORRUPT : TKS_OK) << budget;
  }
}

}  // namespace
}  // namespace tetrakis::test
