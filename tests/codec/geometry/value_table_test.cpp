// SPDX-License-Identifier: Apache-2.0
// Codewords of tables of values. Whole streams: tests/api/few_values_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/geometry/values/value_table_decoder.hpp"
#include "codec/geometry/values/value_table_encoder.hpp"
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

}  // namespace
}  // namespace tetrakis::test
