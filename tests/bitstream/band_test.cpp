// SPDX-License-Identifier: Apache-2.0
// What track coding is made of: arrays of zeros, adaptive models, bit maps of bands, hints.
#include "bitstream/track/band.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/zeroed_array.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/track/band_models.hpp"
#include "tests/support/band_shapes.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {
namespace {

TEST(ZeroedArray, HoldsZerosUntilWritten) {
  for (const size_t size : {size_t{0}, size_t{1}, size_t{1000}, size_t{1} << 20}) {
    ZeroedArray<uint32_t> array(size);
    ASSERT_EQ(array.size(), size);
    ASSERT_EQ(static_cast<size_t>(array.end() - array.begin()), size);
    EXPECT_EQ(static_cast<size_t>(std::count(array.begin(), array.end(), 0u)), size);
    if (size == 0) continue;
    array[size - 1] = 7;
    const uint32_t* data = array.data();
    const ZeroedArray<uint32_t> moved = std::move(array);
    EXPECT_EQ(moved.data(), data);
    EXPECT_EQ(moved[size - 1], 7u);
  }
  EXPECT_EQ(ZeroedArray<int8_t>().size(), 0u);
}

TEST(AdaptiveBit, StaysInRangeAndFollowsEveryDecision) {
  Random random(1);
  for (int initial = -1; initial < 255; ++initial) {
    for (const uint32_t odds : {0u, 1u, 50u, 500u, 1000u}) {
      AdaptiveBit model = initial < 0 ? AdaptiveBit() : AdaptiveBit(static_cast<uint8_t>(initial));
      for (int i = 0; i < 800; ++i) {
        const bool bit = random() % 1000 < odds;
        const uint32_t before = model.zero();
        model.update(bit);
        const uint32_t after = model.zero();
        ASSERT_TRUE(bit ? after <= before : after >= before);
        ASSERT_GE(after, AdaptiveBit::kFloor);
        ASSERT_LE(after, 65536 - AdaptiveBit::kFloor);
      }
      EXPECT_NEAR(model.zero() / 65536.0, 1 - odds / 1000.0, 0.11);
    }
  }
}

/// Krichevsky and Trofimov: k zeros and no one are worth (k + 1/2) / (k + 1).
TEST(AdaptiveBit, StartsLikeARunningMean) {
  AdaptiveBit model;
  for (int k = 0; k < 200; ++k) {
    EXPECT_NEAR(model.zero() / 65536.0, (k + 0.5) / (k + 1), 0.002) << k;
    model.update(false);
  }
}

TEST(AdaptiveBit, TrustsItsInitialValue) {
  for (const int initial : {10, 128, 250}) {
    AdaptiveBit model(static_cast<uint8_t>(initial));
    EXPECT_NEAR(model.zero() / 65536.0, initial / 256.0, 0.001);
    model.update(true);
    EXPECT_NEAR(model.zero() / 65536.0, initial / 256.0, initial / 256.0 / 15);
  }
}

/// A band with random significant coefficients, and an eye that sees them.
struct Scattered {
  Scattered(Random& random, const BandShape& shape)
      : band(shape, Orientation::kHL), set(shape.rows, std::vector<bool>(shape.columns, false)) {
    for (uint32_t i = 0; i < 1 + shape.rows * shape.columns / 40; ++i) {
      const uint32_t row = static_cast<uint32_t>(random() % shape.rows),
                     column = static_cast<uint32_t>(random() % shape.columns);
      set[row][column] = true;
      band.significant[shape.word(row, column / 32)] |= uint32_t{1} << column % 32;
    }
  }
  bool sees(uint32_t row, uint32_t column, uint32_t distance) const {
    for (uint32_t y = row - std::min(row, distance); y <= row + distance && y < set.size(); ++y) {
      for (uint32_t x = column - std::min(column, distance);
           x <= column + distance && x < set[y].size(); ++x) {
        if (set[y][x]) return true;
      }
    }
    return false;
  }
  Band band;
  std::vector<std::vector<bool>> set;
};

TEST(Band, SignificantWithinIsWhatAnEyeSees) {
  Random random(2);
  for (const BandShape& shape : kBandShapes) {
    const Scattered scattered(random, shape);
    for (uint32_t row = 0; row < shape.rows; ++row) {
      for (uint32_t column = 0; column < shape.columns; ++column) {
        const size_t word = shape.word(row, column / 32);
        const uint32_t bit = column % 32;
        const Band::Reach reach = scattered.band.significantWithin(word);
        ASSERT_EQ((reach.two >> bit) & 1, scattered.sees(row, column, 2)) << row << " " << column;
        ASSERT_EQ((reach.three >> bit) & 1, scattered.sees(row, column, 3)) << row << " " << column;
        if (scattered.set[row][column]) continue;
        const uint32_t near = scattered.band.nearSignificant(word);
        ASSERT_EQ((near >> bit) & 1, scattered.sees(row, column, 1)) << row << " " << column;
      }
    }
  }
}

/// A band of random magnitudes, and what they are read as: 0 outside.
Band filled(Random& random, const BandShape& shape) {
  Band band(shape, Orientation::kHL);
  band.makeCells();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t column = 0; column < shape.columns; ++column)
      band.magnitude[shape.cell(row, column)] = static_cast<uint32_t>(random() % 1000);
  }
  return band;
}

uint32_t magnitudeAt(const Band* band, uint32_t row, uint32_t column) {
  if (band == nullptr || row >= band->shape.rows || column >= band->shape.columns) return 0;
  return band->magnitude[band->shape.cell(row, column)];
}

/// Siblings may lack a row, a column, or both, and any of the bands may be missing.
TEST(RowHints, AreSumsAndBitsOfWhatOtherBandsHold) {
  Random random(5);
  for (const BandShape& shape : kBandShapes) {
    const Band parent = filled(random, {(shape.rows + 1) / 2, (shape.columns + 1) / 2});
    const Band companion = filled(random, shape);
    const Band narrow = filled(random, {shape.rows, shape.columns - 1});
    const Band low = filled(random, {shape.rows - 1, shape.columns});
    for (int missing = 0; missing < 5; ++missing) {
      const auto unless = [&](int i, const Band& band) { return i == missing ? nullptr : &band; };
      const HintBands bands{
          unless(0, parent), unless(1, companion), {unless(2, narrow), unless(3, low)}};
      for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t column = 0; column < shape.columns; ++column) {
          const RowHints hints(bands, row, column / 32);
          uint32_t sum = magnitudeAt(bands.parent, row / 2, column / 2);
          uint32_t bits = sum | magnitudeAt(bands.parent, row / 2, column / 2 + 1);
          for (const Band* band : {bands.companion, bands.siblings[0], bands.siblings[1]}) {
            sum += magnitudeAt(band, row, column);
            for (uint32_t i = 0; i < 4; ++i) bits |= magnitudeAt(band, row, column + i);
          }
          ASSERT_EQ(hints.ofOne(column % 32), sum) << row << " " << column << " " << missing;
          if (column % 4 != 0 || column + 4 > shape.columns) continue;
          ASSERT_EQ(hints.ofFour(column % 32), 2 * bits) << row << " " << column << " " << missing;
        }
      }
    }
  }
}

TEST(Band, ValidColumnsAreThoseThatExist) {
  for (const BandShape& shape : kBandShapes) {
    uint32_t columns = 0;
    for (uint32_t x = 0; x < shape.words(); ++x) {
      columns += static_cast<uint32_t>(std::popcount(shape.valid(x)));
      ASSERT_TRUE(shape.valid(x) & 1);
    }
    EXPECT_EQ(columns, shape.columns);
  }
}

}  // namespace
}  // namespace tetrakis::test
