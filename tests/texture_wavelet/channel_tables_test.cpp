// SPDX-License-Identifier: Apache-2.0
// Tables of the values of channels: to a header and back, and from places to samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "conformance/samples/terrain_samples.hpp"
#include "texture_wavelet/tables/channel_tables_encoder.hpp"

namespace tetrakis::test {
namespace {

TextureHeader headerWith(const ChannelTables& tables, tks_sample sample) {
  TextureHeader header;
  header.width = header.height = 9;
  header.channels = 4;
  header.sample = static_cast<uint8_t>(sample);
  header.tables = headerOf(tables, header.sampleBits());
  return header;
}

/// So many values of the type, spread by chance.
std::vector<uint16_t> spread(size_t count, int bits, uint32_t seed) {
  std::vector<uint16_t> values(size_t{1} << bits);
  std::iota(values.begin(), values.end(), uint16_t{0});
  for (size_t i = 0; i < count; ++i) {
    const size_t other = i + samples::hash(static_cast<uint32_t>(i), seed, 9) % (values.size() - i);
    std::swap(values[i], values[other]);
  }
  values.resize(count);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(ChannelTables, ComeBackInAllSizes) {
  for (size_t count = 1; count <= 256; ++count) {
    const ChannelTables tables = {
        spread(count, 8, 1), spread(257 - count, 8, 2), {}, spread(1 + count / 2, 8, 3)};
    ASSERT_EQ(channelTablesOf(headerWith(tables, TKS_U8)), tables) << count;
  }
  for (const size_t count : {1, 2, 1000, 65535, 65536}) {
    const ChannelTables tables = {spread(count, 16, 1), {}, spread(count, 16, 2), {}};
    ASSERT_EQ(channelTablesOf(headerWith(tables, TKS_U16)), tables) << count;
  }
}

/// Multiples, and levels stretched over a type, take few bytes.
TEST(ChannelTables, AreShort) {
  std::vector<uint16_t> multiples(256), stretched(2048), levels(150);
  for (size_t i = 0; i < multiples.size(); ++i) multiples[i] = static_cast<uint16_t>(257 * i);
  for (size_t i = 0; i < stretched.size(); ++i)
    stretched[i] = static_cast<uint16_t>(i * 65535 / (stretched.size() - 1));
  for (size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<uint16_t>(i * 255 / 149);
  EXPECT_LT(headerOf({multiples}, 16).code.size(), 20u);
  EXPECT_LT(headerOf({stretched, stretched, stretched}, 16).code.size(), 300u);
  EXPECT_LT(headerOf({levels}, 8).code.size(), 30u);
}

TEST(ChannelTables, LackWhatACutCodeDoesNotDecide) {
  const ChannelTables tables = {spread(40, 8, 1), spread(90, 8, 2), spread(20, 8, 3)};
  const TextureHeader whole = headerWith(tables, TKS_U8);
  for (size_t bytes = 0; bytes < whole.tables.code.size(); ++bytes) {
    TextureHeader cut = whole;
    cut.tables.code.resize(bytes);
    const ChannelTables known = channelTablesOf(cut);
    bool missing = false;
    for (size_t c = 0; c < known.size(); ++c) {
      missing = missing || known[c].empty();
      EXPECT_TRUE(missing ? known[c].empty() : known[c] == tables[c]) << bytes;
    }
  }
}

TEST(ChannelTables, PlacesBecomeSamplesAndWhatLiesBetween) {
  const std::vector<uint16_t> table = {3, 10, 11, 65535};
  std::vector<int32_t> places = {INT32_MIN, -3, -2, -1, 0, 1, 2, INT32_MAX};
  placesToSamples(table, 2, 0, places);
  EXPECT_EQ(places, (std::vector<int32_t>{3, 3, 3, 10, 11, 65535, 65535, 65535}));
  std::vector<int32_t> halves = {0, 1, 2, 3, 4, 5, 6, 7};
  placesToSamples(table, 0, 1, halves);
  EXPECT_EQ(halves, (std::vector<int32_t>{3, 7, 10, 11, 11, 32773, 65535, 65535}));
  std::vector<int32_t> falling = {0, 1, 2};
  placesToSamples(std::vector<uint16_t>{9, 4}, 0, 1, falling);
  EXPECT_EQ(falling, (std::vector<int32_t>{9, 7, 4}));
}

TEST(FewValues, AreFoundWhereGapsAreWide) {
  Texels texels{64, 64, 2, 8, std::vector<uint16_t>(2 * 64 * 64)};
  for (size_t i = 0; i < texels.samples.size(); i += 2) {
    texels.samples[i] = static_cast<uint16_t>(samples::hash(uint32_t(i), 1, 1) % 85 * 3);
    texels.samples[i + 1] = static_cast<uint16_t>(samples::hash(uint32_t(i), 2, 1) % 256);
  }
  const FewValues few = fewValuesOf(texels, 2, {});
  EXPECT_EQ(few.tables[0].size(), 85u);
  EXPECT_NEAR(few.squares[0], 9, 1e-9);
  EXPECT_TRUE(few.tables[1].empty());
  EXPECT_EQ(few.squares[1], 1);
  std::vector<int32_t> channel = {0, 3, 252};
  samplesToPlaces(few.tables[0], channel);
  EXPECT_EQ(channel, (std::vector<int32_t>{0, 1, 84}));
}

}  // namespace
}  // namespace tetrakis::test
