// SPDX-License-Identifier: Apache-2.0
// Validity masks, masked lifting and corrections: codewords come back from any prefix as far as it
// goes, and no value crosses a coast.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "codec/corrections_decoder.hpp"
#include "codec/corrections_encoder.hpp"
#include "codec/lifting.hpp"
#include "codec/validity_decoder.hpp"
#include "codec/validity_encoder.hpp"
#include "tests/void_masks.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

struct Size {
  uint32_t width, height;
};
constexpr Size kSizes[] = {{2, 2}, {2, 9}, {9, 2}, {5, 3}, {17, 17}, {40, 23}, {64, 65}};

size_t differences(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), size_t{0}, std::plus<>(),
                            std::not_equal_to<>());
}

TEST(Validity, ComesBackWhateverFollows) {
  for (const Size& size : kSizes) {
    for (const VoidShape shape : kVoidShapes) {
      const auto valid = validity(shape, size.width, size.height);
      auto codeword = encodeValidity(valid, size.width, size.height);
      ASSERT_FALSE(codeword.empty());
      ASSERT_EQ(decodeValidity(codeword, size.width, size.height), valid);
      for (const int tail : {0x00, 0xff}) {
        auto longer = codeword;
        longer.insert(longer.end(), 9, static_cast<uint8_t>(tail));
        ASSERT_EQ(decodeValidity(longer, size.width, size.height), valid);
      }
    }
  }
}

TEST(Validity, NoCodewordSaysThatAllIsValid) {
  EXPECT_EQ(decodeValidity({}, 7, 5), std::vector<uint8_t>(35, 1));
}

/// Half of a coast's codeword leaves far fewer samples wrong than none, and the error falls.
TEST(Validity, PrefixesAreCoarseMasks) {
  constexpr uint32_t kSide = 129;
  const auto valid = validity(VoidShape::kCoast, kSide, kSide);
  const auto codeword = encodeValidity(valid, kSide, kSide);
  const auto wrongAfter = [&](size_t bytes) {
    return differences(decodeValidity(std::span(codeword).first(bytes), kSide, kSide), valid);
  };
  const size_t none = wrongAfter(0);
  EXPECT_LT(wrongAfter(codeword.size() / 4), none / 3);
  EXPECT_LT(wrongAfter(codeword.size() / 2), none / 8);
  EXPECT_EQ(wrongAfter(codeword.size()), 0u);
}

/// A coast costs about its length, not its area.
TEST(Validity, CoastsAreCheap) {
  constexpr uint32_t kSide = 257;
  const auto valid = validity(VoidShape::kCoast, kSide, kSide);
  size_t coast = 0;  // pairs of neighbours that differ
  for (uint32_t y = 1; y < kSide; ++y) {
    for (uint32_t x = 1; x < kSide; ++x) {
      const size_t i = size_t{y} * kSide + x;
      coast += (valid[i] != valid[i - 1]) + (valid[i] != valid[i - kSide]);
    }
  }
  EXPECT_LT(encodeValidity(valid, kSide, kSide).size() * 8, 3 * coast / 2);
}

TEST(Validity, AnyBytesDecode) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<uint8_t> bytes(random() % 60);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    for (const uint8_t v : decodeValidity(bytes, 23, 40)) ASSERT_LE(v, 1);
  }
}

std::vector<int32_t> randomValues(size_t count, int32_t bound) {
  std::mt19937 random(9);
  std::vector<int32_t> values(count);
  for (int32_t& v : values) v = static_cast<int32_t>(random() % (2u * bound)) - bound;
  return values;
}

TEST(MaskedLifting, IsReversibleAndStaysOffVoids) {
  for (const Size& size : kSizes) {
    for (const VoidShape shape : kVoidShapes) {
      const auto valid = validity(shape, size.width, size.height);
      const std::vector<int32_t> heights = randomValues(valid.size(), 1 << 26);
      std::vector<int32_t> values = heights;
      forwardLifting({values, size.width, size.height, valid});
      for (size_t i = 0; i < valid.size(); ++i) {
        ASSERT_TRUE(valid[i] || values[i] == heights[i]) << "voids are not written";
        ASSERT_LT(std::abs(int64_t{values[i]}), int64_t{1} << 30) << "nothing is amplified";
      }
      inverseLifting({values, size.width, size.height, valid});
      ASSERT_EQ(values, heights);
    }
  }
}

/// What stands in a void changes no coefficient.
TEST(MaskedLifting, VoidsAreNotRead) {
  for (const VoidShape shape : kVoidShapes) {
    const auto valid = validity(shape, 33, 20);
    std::vector<int32_t> a = randomValues(valid.size(), 1000), b = a;
    for (size_t i = 0; i < valid.size(); ++i) {
      if (!valid[i]) b[i] = 1 << 25;
    }
    forwardLifting({a, 33, 20, valid});
    forwardLifting({b, 33, 20, valid});
    for (size_t i = 0; i < valid.size(); ++i) ASSERT_TRUE(!valid[i] || a[i] == b[i]);
  }
}

/// A plateau beside a void has no details but where nothing coarser is near.
TEST(MaskedLifting, ConstantsHaveFewDetails) {
  const auto valid = validity(VoidShape::kCoast, 65, 65);
  std::vector<int32_t> values(valid.size(), 5000);
  forwardLifting({values, 65, 65, valid});
  size_t details = 0;
  for (size_t i = 0; i < valid.size(); ++i) details += valid[i] && values[i] != 0;
  EXPECT_LT(details, 40u);
}

TEST(MaskedLifting, AllValidIsTheSameAsNoMask) {
  const std::vector<uint8_t> valid(50 * 31, 1);
  std::vector<int32_t> a = randomValues(valid.size(), 1 << 20), b = a;
  forwardLifting(a, 50, 31);
  forwardLifting({b, 50, 31, valid});
  size_t differing = 0;
  for (size_t i = 0; i < a.size(); ++i) differing += a[i] != b[i];
  EXPECT_LT(differing, a.size() / 20) << "the rules differ at corners alone";
}

TEST(Corrections, ComeBackAndPrefixesAgree) {
  std::mt19937 random(4);
  for (const int bits : {1, 3, 17, 32}) {
    for (const VoidShape shape : {VoidShape::kCoast, VoidShape::kOneVoid}) {
      const auto valid = validity(shape, 40, 23);
      std::vector<int32_t> corrections(valid.size());
      std::vector<uint8_t> hints(valid.size());
      for (size_t i = 0; i < valid.size(); ++i) {
        hints[i] = static_cast<uint8_t>(random() % CorrectionGrid::kHints);
        const auto r = static_cast<uint32_t>(random()) >> (32 - bits);
        if (valid[i] && random() % 3 == 0) corrections[i] = static_cast<int32_t>(r);
      }
      const CorrectionGrid grid{40, 23, valid, hints};
      const auto codeword = encodeCorrections(corrections, grid);
      ASSERT_EQ(decodeCorrections(codeword, grid), corrections);
      const auto half = decodeCorrections(std::span(codeword).first(codeword.size() / 2), grid);
      const auto end = std::mismatch(half.begin(), half.end(), corrections.begin()).first;
      EXPECT_GT(end - half.begin(), 200) << "half of the bytes tell a good part";
      EXPECT_TRUE(std::all_of(end, half.end(), [](int32_t c) { return c == 0; }));
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
