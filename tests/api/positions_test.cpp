// SPDX-License-Identifier: Apache-2.0
// Longitudes and latitudes that a stream takes along: what is fitted comes back from every prefix
// and at every level, and nothing that stands there changes what decodes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 30;

/// A grid of degrees that is turned, across 180 degrees.
int turnedGrid(void*, double column, double row, double* longitude, double* latitude) {
  *longitude = 179.9 + 0.01 * column + 0.002 * row;
  *latitude = 65 - 0.01 * row + 0.002 * column;
  return 0;
}

int nowhere(void*, double column, double, double* longitude, double* latitude) {
  *longitude = *latitude = 0;
  return column > 20;
}

/// Too rough for polynomials of few bytes.
int rough(void*, double column, double row, double* longitude, double* latitude) {
  *longitude = std::sin(column * row);
  *latitude = std::cos(3 * column);
  return 0;
}

tks_ground groundOf(tks_locator locate) {
  tks_ground ground = {};
  ground.size = sizeof ground;
  ground.width = kWidth;
  ground.height = kHeight;
  ground.locate = locate;
  return ground;
}

Bytes fitted(tks_locator locate) {
  const tks_ground ground = groundOf(locate);
  tks_buffer buffer = {};
  EXPECT_EQ(tks_fit_positions(&ground, &buffer), TKS_OK);
  Bytes bytes(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return bytes;
}

class PositionsTest : public testing::Test {
 protected:
  PositionsTest() {
    for (size_t i = 0; i < samples_.size(); ++i) samples_[i] = static_cast<uint8_t>(i * i / 7);
    heights_.size = sizeof heights_;
    heights_.width = kWidth;
    heights_.height = kHeight;
    heights_.data = samples_.data();
    heights_.scale = 1;
    give(heights_, positions_);
    place(heights_, {1000, 10, 0, 2000, 0, -10});
    image_.size = sizeof image_;
    image_.width = 2 * kWidth;
    image_.height = kHeight;
    image_.channels = 1;
    image_.data = samples_.data();
  }
  template <class T>
  static void give(T& raster, const Bytes& positions) {
    raster.positions = positions.data();
    raster.positions_size = positions.size();
  }
  template <class T>
  static void place(T& raster, const std::array<double, 6>& transform) {
    std::copy(transform.begin(), transform.end(), raster.geotransform);
    raster.has_geotransform = 1;
  }
  Bytes encode(bool textured) {
    const tks_encode_options options = lossless();
    tks_buffer buffer = {};
    char message[200] = "";
    EXPECT_EQ(tks_encode(&heights_, textured ? &image_ : nullptr, &options, &buffer, message,
                         sizeof message),
              TKS_OK)
        << message;
    Bytes stream(buffer.data, buffer.data + buffer.size);
    tks_free_buffer(&buffer);
    return stream;
  }

  std::vector<uint8_t> samples_ = std::vector<uint8_t>(2 * kWidth * kHeight);
  const Bytes positions_ = fitted(turnedGrid);
  tks_heights heights_ = {};
  tks_image image_ = {};
};

void expectPlace(tks_decoder* decoder, const tks_pixel& pixel, double column, double row) {
  double longitude = 0, latitude = 0, wanted_longitude = 0, wanted_latitude = 0;
  ASSERT_EQ(tks_locate(decoder, &pixel, &longitude, &latitude), TKS_OK) << tks_message(decoder);
  turnedGrid(nullptr, column, row, &wanted_longitude, &wanted_latitude);
  EXPECT_NEAR(std::remainder(longitude - wanted_longitude, 360), 0, 0.0025);
  EXPECT_NEAR(latitude, wanted_latitude, 0.001);
}

TEST_F(PositionsTest, ComeBackFromTheHeaderAtEveryLevel) {
  EXPECT_LE(positions_.size(), size_t{TKS_MOST_POSITION_BYTES});
  const Bytes stream = encode(false);
  const Stream whole(stream);
  Stream header(Prefix(stream).first(whole.info().header_bytes));
  const tks_info& info = header.info();
  EXPECT_EQ(Bytes(info.positions, info.positions + info.positions_size), positions_);
  EXPECT_EQ(info.texture_positions, nullptr);
  for (const double column : {0.0, 0.5, 20.0, 40.0}) {
    for (const double row : {0.0, 29.5, 30.0})
      expectPlace(header.get(), {TKS_PART_HEIGHTS, column, row}, column, row);
  }
  ASSERT_EQ(tks_set_levels(header.get(), 2, 0), TKS_OK);
  expectPlace(header.get(), {TKS_PART_HEIGHTS, 3.5, 5.5}, 12.5, 20.5);
}

TEST_F(PositionsTest, OfATextureAreThoseOfTheHeightsInTheSameSystem) {
  place(image_, {1100, 5, 0, 1950, 0, -10});  // from sample (10, 5) on, texels half as wide
  const Bytes stream = encode(true);
  Stream decoder(stream);
  expectPlace(decoder.get(), {TKS_PART_TEXTURE, 8, 3}, 14, 8);
  image_.crs = "EPSG:4326";
  const Bytes other = encode(true);
  Stream elsewhere(other);
  const tks_pixel pixel = {TKS_PART_TEXTURE, 8, 3};
  double longitude = -1, latitude = -1;
  EXPECT_EQ(tks_locate(elsewhere.get(), &pixel, &longitude, &latitude), TKS_UNSUPPORTED);
  EXPECT_EQ(longitude, -1);
}

TEST_F(PositionsTest, OfATextureMayBeItsOwn) {
  give(image_, positions_);
  place(image_, {1100, 5, 0, 1950, 0, -10});
  const Bytes stream = encode(true);
  Stream decoder(stream);
  expectPlace(decoder.get(), {TKS_PART_TEXTURE, 16, 3}, 8, 3);
  expectPlace(decoder.get(), {TKS_PART_HEIGHTS, 16, 3}, 16, 3);
}

TEST_F(PositionsTest, AreRefusedWhereTheyAreNone) {
  const tks_encode_options options = lossless();
  const auto status = [&] {
    tks_buffer buffer = {};
    const tks_status got = tks_encode(&heights_, nullptr, &options, &buffer, nullptr, 0);
    tks_free_buffer(&buffer);
    return got;
  };
  EXPECT_EQ(status(), TKS_OK);
  for (size_t size = 0; size < positions_.size(); ++size) {
    heights_.positions_size = size;
    EXPECT_EQ(status(), TKS_USAGE) << size;
  }
}

TEST(FitPositions, SaysWhatItCannotDo) {
  tks_buffer buffer = {};
  for (const tks_locator locate : {nowhere, rough}) {
    const tks_ground ground = groundOf(locate);
    EXPECT_EQ(tks_fit_positions(&ground, &buffer), TKS_UNSUPPORTED);
    EXPECT_EQ(buffer.data, nullptr);
  }
  tks_ground ground = groundOf(turnedGrid);
  ground.width = 0;
  EXPECT_EQ(tks_fit_positions(&ground, &buffer), TKS_USAGE);
  EXPECT_EQ(tks_fit_positions(nullptr, &buffer), TKS_USAGE);
  ground = groundOf(nullptr);
  EXPECT_EQ(tks_fit_positions(&ground, &buffer), TKS_USAGE);
}

/// The stream with other positions of its heights.
Bytes withPositions(const Bytes& stream, std::string positions) {
  auto parsed = readHeader(stream);
  const size_t begin = parsed->bytes;
  parsed->header.height_positions = std::move(positions);
  Bytes out = writeHeader(parsed->header);
  out.insert(out.end(), stream.begin() + static_cast<std::ptrdiff_t>(begin), stream.end());
  return out;
}

TEST_F(PositionsTest, OfAnotherFormAreNone) {
  const Bytes stream = encode(false);
  const std::string known(positions_.begin(), positions_.end());
  for (const Bytes& bytes : {withPositions(stream, known + "x"), withPositions(stream, ""),
                             withPositions(stream, known.substr(0, known.size() - 1))}) {
    Stream decoder(bytes);
    EXPECT_EQ(decoder.info().positions, nullptr);
    const tks_pixel pixel = {TKS_PART_HEIGHTS, 1, 1};
    double longitude = 0, latitude = 0;
    EXPECT_EQ(tks_locate(decoder.get(), &pixel, &longitude, &latitude), TKS_UNSUPPORTED);
    std::vector<uint8_t> decoded(kWidth * kHeight);
    ASSERT_EQ(tks_decode_heights(decoder.get(), decoded.data(), decoded.size()), TKS_OK);
    EXPECT_TRUE(std::equal(decoded.begin(), decoded.end(), samples_.begin()));
  }
}

/// Whatever bytes stand there, places are numbers.
TEST_F(PositionsTest, OfAnyBytesAreNumbersOrNone) {
  const Bytes stream = encode(false);
  std::mt19937 random(5);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes(positions_.begin(), positions_.end());
    for (int change = 0; change < 1 + round % 3; ++change)
      bytes[random() % bytes.size()] = char(random());
    Stream decoder(withPositions(stream, bytes));
    const tks_pixel pixel = {TKS_PART_HEIGHTS, 50.0 * (round % 3), -3};
    double longitude = 0, latitude = 0;
    const tks_status status = tks_locate(decoder.get(), &pixel, &longitude, &latitude);
    EXPECT_TRUE(status == TKS_OK || status == TKS_UNSUPPORTED);
    EXPECT_TRUE(std::isfinite(longitude) && std::abs(latitude) <= 90);
  }
}

}  // namespace
}  // namespace tetrakis::test
