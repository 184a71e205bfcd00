// SPDX-License-Identifier: Apache-2.0
// Tables of values: codewords, and streams of heights that have few values.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "codec/geometry/value_table_decoder.hpp"
#include "codec/geometry/value_table_encoder.hpp"
#include "conformance/samples/few_values.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::FewValues;
using samples::make;
using samples::Pattern;
using samples::Raster;

/// Tables of gaps that repeat, that wander, that are anything; around 0 and around 2^32.
std::vector<ValueTable> tables() {
  std::vector<ValueTable> out = {{{0, 1}}, {{0xffffffffu, 0}}, {{5, 0x80000005u}}};
  for (uint32_t trial = 0; trial < 24; ++trial) {
    ValueTable table{{samples::hash(trial, 0, 61)}};
    for (uint32_t i = 1; i < 3 + 40 * trial; ++i) {
      const uint32_t h = samples::hash(trial, i, 62);
      const uint32_t gap = trial % 3 == 0   ? 3 + (i % 3 == 0)
                           : trial % 3 == 1 ? 1 + (h >> (i / 2 % 31))
                                            : 1000 + h % (trial + 1);
      table.words.push_back(table.words.back() + std::max(gap, 1u));
    }
    out.push_back(table);
  }
  return out;
}

TEST(ValueTable, ComesBackFromItsCodeword) {
  for (const ValueTable& table : tables()) {
    const std::vector<uint8_t> codeword = encodeValueTable(table);
    const auto values = static_cast<uint32_t>(table.words.size());
    ASSERT_EQ(decodeValueTable(codeword, values).words, table.words);
    for (size_t n = 0; n < codeword.size(); n += 1 + n / 8) {
      const ValueTable cut = decodeValueTable(std::span(codeword).first(n), values);
      ASSERT_TRUE(cut.empty()) << n << " of " << codeword.size() << " bytes";
    }
  }
}

TEST(ValueTable, RegularGapsTakeLittle) {
  ValueTable feet{{1000}};
  for (uint32_t i = 1; i < 10000; ++i) feet.words.push_back(feet.words.back() + 3 + (i % 7 < 2));
  EXPECT_LT(encodeValueTable(feet).size(), 1000u);
}

std::string nameOf(FewValues kind) {
  constexpr const char* kNames[] = {"feet", "rescaled", "rare", "stretched"};
  return kNames[static_cast<size_t>(kind)];
}

/// Beside the same terrain in whole numbers, the values cost their table, and exceptions.
TEST(FewValues, TakeLittleMoreThanWholeNumbers) {
  const Raster whole = make({Pattern::kRidges, 150, 140, 1, TKS_U8, 3});
  const size_t plain = encode(&whole, nullptr, lossless()).size();
  for (const FewValues kind : samples::kFewValues) {
    SCOPED_TRACE(nameOf(kind));
    const Raster heights = samples::withFewValues(whole, kind);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_TRUE(Stream(stream).heights() == heights.data);
    EXPECT_EQ(Stream(stream).info().lossless, 1);
    const size_t exceptions = kind == FewValues::kRare ? 150 * 140 / 100 * 4 : 0;
    EXPECT_LT(stream.size(), plain + plain / 50 + 400 + exceptions);
  }
}

/// What a prefix shows are values of the table: nothing lies between them.
TEST(FewValues, PrefixesShowValuesOfTheTable) {
  const Raster heights =
      samples::withFewValues(make({Pattern::kSteps, 90, 70, 1, TKS_U8, 5}), FewValues::kFeet);
  const Bytes stream = encode(&heights, nullptr, lossless());
  const auto samplesOf = [](const std::vector<std::byte>& bytes) {
    std::vector<float> out(bytes.size() / 4);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  };
  std::vector<float> values = samplesOf(heights.data);
  std::sort(values.begin(), values.end());
  for (size_t n = stream.size() / 2; n < stream.size(); n += 1 + stream.size() / 40) {
    Stream prefix(Prefix(stream).first(n));
    for (const float sample : samplesOf(prefix.heights()))
      ASSERT_TRUE(std::binary_search(values.begin(), values.end(), sample)) << sample;
  }
}

}  // namespace
}  // namespace tetrakis::test
