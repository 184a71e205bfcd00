// SPDX-License-Identifier: Apache-2.0
// Codewords of tables of values. Whole streams: tests/api/few_values_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/geometry/quantiser/value_choice.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::test {
namespace {

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

TEST(ValueGaps, OnlyWideOnesHaveBridges) {
  const ValueGaps gaps({-9999, 1, 2, 3, 7, 8, 9, 500, 501, 502});
  for (size_t i = 0; i <= 10; ++i) EXPECT_EQ(gaps.bridge(i).empty(), i != 1 && i != 7) << i;
  const std::vector<double> below = gaps.bridge(1), between = gaps.bridge(7);
  EXPECT_TRUE(std::is_sorted(below.begin(), below.end()));
  EXPECT_EQ(below.back(), 0);  // as far from the ground as its next value
  EXPECT_GT(below.front(), -9999);
  EXPECT_LT(below.front(), -4000);
  EXPECT_TRUE(std::is_sorted(between.begin(), between.end()));
  EXPECT_EQ(between.front(), 10);
  EXPECT_EQ(between.back(), 499);
  EXPECT_TRUE(ValueGaps({0, 10000}).bridge(1).empty());
}

TEST(ValueGaps, EvenOnesCostPrefixesNothing) {
  const std::vector<uint32_t> samples(5, 10);
  EXPECT_NEAR(ValueGaps({0, 3, 6, 9, 12}).unevenness(samples), 0, 1e-9);
  EXPECT_NEAR(ValueGaps({-9999, 3, 6, 9, 12}).unevenness(samples), 0, 1e-9);
  EXPECT_GT(ValueGaps({0, 1, 2, 12, 22}).unevenness(samples), 0.5);
}

}  // namespace
}  // namespace tetrakis::test
