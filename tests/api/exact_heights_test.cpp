// SPDX-License-Identifier: Apache-2.0
// Where a budget comes near heights to the last bit, a stream of heights and texture has them exact
// if that leaves a better picture, and its prefixes stay what they were.
#include <cmath>
#include <cstring>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr uint32_t kWidth = 90, kHeight = 70;

const Raster& picture() {
  static const Raster image = make({Pattern::kRidges, 110, 90, 3, TKS_U8});
  return image;
}

/// Smooth hills as floats, in whole metres, or off by some millimetres, which no step shows.
Raster hills(bool whole) {
  Raster raster = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_F32});
  uint32_t noise = 1;
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const double x = i % kWidth, y = i / kWidth;
    noise = noise * 1664525 + 1013904223;
    const double metres =
        std::round(900 + 70 * std::sin(x / 9 + y / 23) + 50 * std::cos(y / 7) + x);
    const auto height = static_cast<float>(whole ? metres : metres + (noise >> 8) * 0x1p-24 * 0.01);
    std::memcpy(raster.data.data() + i * sizeof height, &height, sizeof height);
  }
  return raster;
}

/// Ground of whole metres gets them, and more of its picture than ground that has no last bit.
TEST(ExactHeights, LeaveABetterPicture) {
  const Raster whole = hills(true), jittered = hills(false);
  for (const uint64_t bytes : {5000u, 9000u}) {
    Stream exact(encode(&whole, &picture(), budget(bytes)));
    Stream lossy(encode(&jittered, &picture(), budget(bytes)));
    const double texture = squaredError(picture(), exact.texture());
    EXPECT_EQ(squaredError(whole, exact.heights()), 0) << bytes;
    EXPECT_GT(texture, 0) << bytes;
    EXPECT_LT(texture, squaredError(picture(), lossy.texture())) << bytes;
  }
}

/// Cut early it is about as good, in the mean, as streams of few bytes, whose heights end with an
/// error.
TEST(ExactHeights, TakeLittleFromPrefixes) {
  const Raster surface = hills(true);
  const Bytes exact = encode(&surface, &picture(), budget(11000));
  double logarithms = 0;
  for (const uint64_t bytes : {300u, 400u, 500u, 700u}) {
    Stream cut(Prefix(exact).first(bytes)), made(encode(&surface, &picture(), budget(bytes)));
    const double lossy = squaredError(surface, made.heights());
    EXPECT_GT(lossy, 0) << bytes;
    const double more_of_texture =
        squaredError(picture(), cut.texture()) / squaredError(picture(), made.texture());
    logarithms += std::log(squaredError(surface, cut.heights()) / lossy * more_of_texture);
  }
  EXPECT_LT(logarithms / 4, std::log(1.25));
}

/// Floats that are on no grid have no lossy coding of any PSNR; every bit has.
TEST(ExactHeights, ReachEveryPsnr) {
  constexpr double kRange = 300, kBeyond = 1000;  // metres, at least; dB of no float
  const Raster surface = hills(false);
  for (const double psnr : {100.0, kBeyond}) {
    tks_encode_options options = budget(0);
    options.psnr = psnr;
    Stream alone(encode(&surface, nullptr, options));
    Stream both(encode(&surface, &picture(), options));
    for (Stream* stream : {&alone, &both}) {
      const double squares = squaredError(surface, stream->heights());
      EXPECT_LE(squares, kWidth * kHeight * kRange * kRange * std::pow(10, -psnr / 10)) << psnr;
      EXPECT_TRUE(psnr < kBeyond || stream->heights() == surface.data);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
