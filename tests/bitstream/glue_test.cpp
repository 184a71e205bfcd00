// SPDX-License-Identifier: Apache-2.0
// Which sides of a forest are glued, as a codeword.
#include "bitstream/stream/glue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace tetrakis {
namespace {

using Sides = std::vector<uint32_t>;

void glue(Sides& sides, uint32_t a, uint32_t b) {
  sides[a] = b;
  sides[b] = a;
}

/// A grid of patches, whose ends may be joined.
Sides grid(uint32_t columns, uint32_t rows, bool torus) {
  Sides sides(size_t{4} * columns * rows, Forest::kBorder);
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const uint32_t here = y * columns + x;
      if (torus || x + 1 < columns)
        glue(sides, 4 * here + 1, 4 * (y * columns + (x + 1) % columns) + 3);
      if (torus || y + 1 < rows) glue(sides, 4 * here + 2, 4 * ((y + 1) % rows * columns + x));
    }
  }
  return sides;
}

/// Any sides are glued to any others, or to none.
Sides anyForest(std::mt19937& random, uint32_t patches) {
  Sides sides(size_t{4} * patches, Forest::kBorder), order(sides.size());
  std::iota(order.begin(), order.end(), 0u);
  for (size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random() % (i + 1)]);
  const size_t glued = random() % (order.size() / 2 + 1);
  for (size_t i = 0; i < glued; ++i) glue(sides, order[2 * i], order[2 * i + 1]);
  return sides;
}

/// The same surface with patches numbered and turned as a walk meets them.
Sides asMet(const Sides& sides) {
  const std::vector<MetFace> met = facesAsMet(sides, Forest::kSides);
  Sides number(sides.size());
  for (uint32_t i = 0; i < met.size(); ++i) {
    for (uint32_t k = 0; k < 4; ++k) number[4 * met[i].face + (met[i].entered + k) % 4] = 4 * i + k;
  }
  Sides renamed(sides.size(), Forest::kBorder);
  for (size_t side = 0; side < sides.size(); ++side)
    if (sides[side] != Forest::kBorder) renamed[number[side]] = number[sides[side]];
  return renamed;
}

std::vector<Sides> forests() {
  std::vector<Sides> all = {grid(1, 1, false), grid(1, 1, true), grid(2, 2, false),
                            grid(7, 5, true), grid(9, 4, false)};
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i)
    all.push_back(anyForest(random, static_cast<uint32_t>(1 + random() % 12)));
  for (size_t i = 0, count = all.size(); i < count; ++i) all.push_back(asMet(all[i]));
  return all;
}

TEST(Glue, ComesBack) {
  for (const Sides& sides : forests()) {
    const auto read = decodeGlue(encodeGlue(sides), static_cast<uint32_t>(sides.size() / 4));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, sides);
  }
}

TEST(Glue, NumbersOfAWalkAreAllDifferent) {
  for (const Sides& sides : forests()) {
    const Sides met = asMet(sides);
    EXPECT_TRUE(Forest::isSound(met));
    const auto borders = [](const Sides& of) {
      return std::count(of.begin(), of.end(), Forest::kBorder);
    };
    EXPECT_EQ(borders(met), borders(sides));
    EXPECT_EQ(asMet(met), met) << "a walk over its own numbers finds them again";
  }
}

TEST(Glue, OfACutOrDamagedCodewordIsSoundOrNothing) {
  std::mt19937 random(2);
  for (const Sides& sides : forests()) {
    const auto patches = static_cast<uint32_t>(sides.size() / 4);
    const std::string whole = encodeGlue(sides);
    for (size_t length = 0; length < whole.size(); ++length) {
      const auto read = decodeGlue(whole.substr(0, length), patches);
      EXPECT_TRUE(!read || *read == sides) << "a cut decides nothing wrong";
    }
    for (size_t at = 0; at < whole.size(); ++at) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 + random() % 255));
      const auto read = decodeGlue(damaged, patches);
      EXPECT_TRUE(!read || Forest::isSound(*read));
    }
    const auto more = decodeGlue(whole, patches + 1);
    EXPECT_TRUE(!more || Forest::isSound(*more));
  }
}

TEST(Glue, OfRegularPatchesTakesFewBits) {
  const Sides torus = asMet(grid(40, 40, true)), plane = asMet(grid(40, 40, false));
  EXPECT_LT(encodeGlue(torus).size(), 80u);
  EXPECT_LT(encodeGlue(plane).size(), 80u);
}

}  // namespace
}  // namespace tetrakis
