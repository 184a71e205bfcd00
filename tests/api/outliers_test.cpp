// SPDX-License-Identifier: Apache-2.0
// Undeclared nodata: what is found, what stays a height, and what declaring it is good for.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::test {
namespace {

template <class T>
constexpr tks_sample sampleOf() {
  if constexpr (std::is_same_v<T, float>) return TKS_F32;
  if constexpr (std::is_same_v<T, uint8_t>) return TKS_U8;
  if constexpr (std::is_same_v<T, uint16_t>) return TKS_U16;
  if constexpr (std::is_same_v<T, int16_t>) return TKS_I16;
  return TKS_I32;
}

template <class T>
tks_heights heightsOf(const std::vector<T>& samples) {
  tks_heights heights = makeHeights();
  heights.width = static_cast<uint32_t>(samples.size());
  heights.height = 1;
  heights.sample = sampleOf<T>();
  heights.data = samples.data();
  return heights;
}

template <class T>
tks_outliers outliersOf(const std::vector<T>& samples) {
  const tks_heights heights = heightsOf(samples);
  tks_outliers found{sizeof found, 0, 0, 0};
  EXPECT_EQ(tks_find_outliers(&heights, &found), TKS_OK);
  return found;
}

constexpr float kLowest = std::numeric_limits<float>::lowest();

TEST(Outliers, NumbersThatFilesWriteWithoutAHeightAreFill) {
  const auto expectFill = [](const auto& samples, double value, uint64_t count) {
    const tks_outliers found = outliersOf(samples);
    EXPECT_TRUE(found.is_fill) << value;
    EXPECT_EQ(found.value, value);
    EXPECT_EQ(found.count, count) << value;
  };
  expectFill(std::vector<float>{1, kLowest, 7, kLowest, 3}, double{kLowest}, 2);
  expectFill(std::vector<float>{1, 1e20F, 7, 1e20F, 3}, double{1e20F}, 2);
  expectFill(std::vector<float>{1, -1e10F, 7, -1e10F, 3}, -1e10, 2);
  expectFill(std::vector<float>{1, -9999, 2, -9999, 1500, std::nanf("")}, -9999, 2);
  expectFill(std::vector<float>{1, 2, -32767, -32767, 15}, -32767, 2);
  expectFill(std::vector<int16_t>{-400, 8848, -9999, 3, -9999}, -9999, 2);
  expectFill(std::vector<int16_t>{-400, 8848, -32768, 3}, -32768, 1);
  expectFill(std::vector<int32_t>{0, 50000, -999999, -999999, 3}, -999999, 2);
}

TEST(Outliers, OtherNumbersThatLieFarAwayAreNoFill) {
  const auto expectOutlier = [](const auto& samples, double value) {
    const tks_outliers found = outliersOf(samples);
    EXPECT_GT(found.count, 0U) << value;
    EXPECT_EQ(found.value, value);
    EXPECT_FALSE(found.is_fill) << value;
  };
  expectOutlier(std::vector<float>{1, kLowest, 2e30F, 3}, double{kLowest});
  expectOutlier(std::vector<float>{1, -9998, 1500, -9998}, -9998);
  expectOutlier(std::vector<int16_t>{-400, 30000, 8848, 30000}, 30000);
  expectOutlier(std::vector<uint16_t>{0, 900, 9999, 9999, 3}, 9999);
  expectOutlier(std::vector<uint16_t>{0, 0, 40000, 40010}, 0);
}

TEST(Outliers, HeightsAreNone) {
  EXPECT_EQ(outliersOf(std::vector<float>{kLowest, kLowest}).count, 0U) << "there is nothing else";
  EXPECT_EQ(outliersOf(std::vector<float>{3, 3, -9999, -9999}).count, 0U) << "two values";
  EXPECT_EQ(outliersOf(std::vector<float>{-10900, 10, -9999, -9999}).count, 0U) << "others near";
  EXPECT_EQ(outliersOf(std::vector<float>{1, 2, -9999, 7}).count, 0U) << "a single one";
  EXPECT_EQ(outliersOf(std::vector<uint16_t>{0, 0, 5, 30, 25}).count, 0U) << "bare ground";
  EXPECT_EQ(outliersOf(std::vector<uint8_t>{0, 1, 255, 255}).count, 0U) << "8 bits";
  EXPECT_EQ(outliersOf(std::vector<float>{std::nanf("")}).count, 0U);
}

/// A declared nodata value is no height, and hides no other number that is none.
TEST(Outliers, AreFoundBesideADeclaredNodataValue) {
  const std::vector<float> holes = {1, -9999, 2, -9999, 1500};
  const std::vector<int16_t> mixed = {5, -32768, 900, -32767, 40, -32768};
  const auto besideNodata = [](tks_heights declared, double nodata) {
    declared.has_nodata = 1;
    declared.nodata = nodata;
    tks_outliers found{sizeof found, 9, 9, 9};
    EXPECT_EQ(tks_find_outliers(&declared, &found), TKS_OK);
    return found;
  };
  EXPECT_EQ(besideNodata(heightsOf(holes), -9999).count, 0U);
  EXPECT_EQ(besideNodata(heightsOf(holes), -9999.0001).count, 0U) << "the nearest float";
  for (const double other : {7.0, 1e30, std::numeric_limits<double>::lowest(), std::nan("")}) {
    const tks_outliers found = besideNodata(heightsOf(holes), other);
    EXPECT_EQ(found.count, 2U) << other;
    EXPECT_EQ(found.value, -9999) << other;
    EXPECT_TRUE(found.is_fill) << other;
  }
  const tks_outliers found = besideNodata(heightsOf(mixed), -32767);
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.value, -32768);
}

TEST(Outliers, WrongArgumentsAreRefused) {
  const std::vector<float> samples = {1, 2};
  tks_heights heights = heightsOf(samples);
  tks_outliers found{sizeof found, 0, 0, 0};
  EXPECT_EQ(tks_find_outliers(nullptr, &found), TKS_USAGE);
  EXPECT_EQ(tks_find_outliers(&heights, nullptr), TKS_USAGE);
  found.size = 8;
  EXPECT_EQ(tks_find_outliers(&heights, &found), TKS_USAGE);
  found.size = sizeof found;
  heights.data = nullptr;
  EXPECT_EQ(tks_find_outliers(&heights, &found), TKS_USAGE);
}

/// Holes at random places of smooth ground, in a stream of a tenth of a bit a sample.
double groundError(bool declared) {
  constexpr uint32_t kSide = 128;
  std::vector<int16_t> samples(size_t{kSide} * kSide);
  const auto isHole = [](size_t i) { return i * 2654435761U % 97 == 0; };
  for (size_t i = 0; i < samples.size(); ++i) {
    const double x = double(i % kSide), y = double(i / kSide);
    samples[i] = static_cast<int16_t>(isHole(i) ? -9999 : 300 * std::sin(x / 20 + y / 50));
  }
  tks_heights heights = heightsOf(samples);
  heights.width = heights.height = kSide;
  if (declared) {
    tks_outliers found{sizeof found, 0, 0, 0};
    EXPECT_EQ(tks_find_outliers(&heights, &found), TKS_OK);
    heights.has_nodata = found.is_fill;
    heights.nodata = found.value;
  }
  tks_encode_options options = makeEncodeOptions();
  options.bytes = 400;
  const Result<Buffer> stream = tetrakis::encode(&heights, nullptr, options);
  EXPECT_TRUE(stream.ok());
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  EXPECT_TRUE(decoder.ok());
  const Result<std::vector<std::byte>> bytes = decoder->heights();
  EXPECT_TRUE(bytes.ok());
  std::vector<int16_t> decoded(samples.size());
  std::memcpy(decoded.data(), bytes->data(), bytes->size());
  double sum = 0;
  for (size_t i = 0; i < samples.size(); ++i)
    if (!isHole(i)) sum += std::pow(samples[i] - decoded[i], 2);
  return std::sqrt(sum / double(samples.size()));
}

TEST(Outliers, DeclaredTheyLeaveTheGroundItsBytes) {
  EXPECT_LT(20 * groundError(true), groundError(false));
}

}  // namespace
}  // namespace tetrakis::test
