// SPDX-License-Identifier: Apache-2.0
// Validity masks, the levels they are coded by, and corrections: codewords come back from any
// prefix as far as it goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/lattice/levels.hpp"
#include "codec/lattice/validity.hpp"
#include "conformance/samples/void_masks.hpp"

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

TEST(Levels, EveryVertexBelongsToExactlyOneLevel) {
  for (const Size& size : kSizes) {
    std::vector<int> owners(size_t{size.width} * size.height, 0);
    for (const Level& level : levelsOf(size.width, size.height)) {
      for (uint32_t row = 0; row < level.rows; ++row) {
        for (uint32_t column = 0; column < level.columns[row % 2]; ++column) {
          const uint32_t x = level.firstX(row) + column * level.pitch();
          ASSERT_LT(x, size.width);
          ASSERT_LT(level.y(row), size.height);
          ++owners[size_t{level.y(row)} * size.width + x];
        }
      }
    }
    for (int count : owners) ASSERT_EQ(count, 1);
  }
}

TEST(Validity, ComesBackWhateverFollows) {
  for (const Size& size : kSizes) {
    for (const VoidShape shape : kVoidShapes) {
      const auto valid = validity(shape, size.width, size.height);
      auto codeword = encodeValidity({valid, {size.width, size.height}});
      ASSERT_FALSE(codeword.empty());
      ASSERT_EQ(decodeValidity(codeword, {size.width, size.height}).bytes(), valid);
      for (const int tail : {0x00, 0xff}) {
        auto longer = codeword;
        longer.insert(longer.end(), 9, static_cast<uint8_t>(tail));
        ASSERT_EQ(decodeValidity(longer, {size.width, size.height}).bytes(), valid);
      }
    }
  }
}

TEST(Validity, NoCodewordSaysThatAllIsValid) {
  EXPECT_EQ(decodeValidity({}, {7, 5}).bytes(), std::vector<uint8_t>(35, 1));
}

/// Half of a coast's codeword leaves far fewer samples wrong than none, and the error falls.
TEST(Validity, PrefixesAreCoarseMasks) {
  constexpr uint32_t kSide = 129;
  const auto valid = validity(VoidShape::kCoast, kSide, kSide);
  const auto codeword = encodeValidity({valid, {kSide, kSide}});
  const auto wrongAfter = [&](size_t bytes) {
    return differences(decodeValidity(std::span(codeword).first(bytes), {kSide, kSide}).bytes(),
                       valid);
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
  EXPECT_LT(encodeValidity({valid, {kSide, kSide}}).size() * 8, 3 * coast / 2);
}

TEST(Validity, AnyBytesDecode) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<uint8_t> bytes(random() % 60);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    for (const uint8_t v : decodeValidity(bytes, {23, 40}).bytes()) ASSERT_LE(v, 1);
  }
}

/// A decoder's side that takes every decision by itself.
struct OneByOne {
  RangeDecoder decoder;

  uint64_t asked(const SampleLine& line) const { return lowBits(line.count); }
  bool bit(AdaptiveBit& model, size_t) { return decoder.decode(model); }
  uint32_t run(AdaptiveBit&, bool, uint32_t) { return 0; }
  bool stopped() const { return decoder.exhausted(); }
  uint64_t otherwise(uint64_t, uint64_t majority) const { return majority; }
};

/// Wherever bytes end in a run, and whatever comes behind it.
TEST(Validity, RunsAreDecisionsOneByOne) {
  std::mt19937 random(6);
  for (const Extent plane : {Extent{700, 300}, Extent{3, 900}, Extent{513, 4}}) {
    for (int trial = 0; trial < 60; ++trial) {
      std::vector<uint8_t> bytes(1 + random() % 8, trial % 2 == 0 ? 0x00 : 0xff);
      if (trial % 2 == 1) bytes.push_back(0xfe);
      for (auto more = random() % 9; more > 0; --more)
        bytes.push_back(static_cast<uint8_t>(random()));
      OneByOne io{RangeDecoder(bytes)};
      ASSERT_EQ(decodeValidity(bytes, plane).bytes(),
                ValidityPass<OneByOne>(plane, io).run().bytes())
          << plane.width << " x " << plane.height << ", trial " << trial;
    }
  }
}

/// 0 where nothing is decided.
std::vector<int32_t> decodedCorrections(std::span<const uint8_t> codeword,
                                        const CorrectionHints& hints) {
  std::vector<int32_t> corrections(hints.extent().samples());
  decodeCorrections(codeword, hints, [&](size_t first, std::span<const int32_t> row) {
    std::copy(row.begin(), row.end(), corrections.begin() + static_cast<ptrdiff_t>(first));
  });
  return corrections;
}

TEST(Corrections, ComeBackAndPrefixesAgree) {
  std::mt19937 random(4);
  for (const int bits : {1, 3, 17, 32}) {
    for (const VoidShape shape : {VoidShape::kCoast, VoidShape::kOneVoid}) {
      const auto valid = validity(shape, 40, 23);
      std::vector<int32_t> corrections(valid.size());
      std::vector<uint8_t> hints(valid.size());
      for (size_t i = 0; i < valid.size(); ++i) {
        hints[i] = static_cast<uint8_t>(random() % NumberSize::kPlaces);
        const auto r = static_cast<uint32_t>(random()) >> (32 - bits);
        if (valid[i] && random() % 3 == 0) corrections[i] = static_cast<int32_t>(r);
      }
      const CorrectionHints grid{hints, {40, 23}, valid};
      const auto codeword = encodeCorrections(corrections, grid);
      ASSERT_EQ(decodedCorrections(codeword, grid), corrections);
      const auto half = decodedCorrections(std::span(codeword).first(codeword.size() / 2), grid);
      const auto end = std::mismatch(half.begin(), half.end(), corrections.begin()).first;
      EXPECT_GT(end - half.begin(), 200) << "half of the bytes tell a good part";
      EXPECT_TRUE(std::all_of(end, half.end(), [](int32_t c) { return c == 0; }));
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
