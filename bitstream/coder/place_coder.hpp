// SPDX-License-Identifier: Apache-2.0
// PlaceCoder codes places on a grid, each as its differences from an expected one: the number of
// bits of a difference in unary, of which several models know something, then the bits below the
// highest, and the sign. Differences are about as large as those of the places nearby.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/coder/mixture.hpp"

namespace tetrakis::inline coder {

/// The mean of `count` whole numbers, halves rounded up. count: above 0.
inline int64_t roundedMean(int64_t sum, int64_t count) {
  const int64_t doubled = 2 * sum + count, divisor = 2 * count;
  return doubled / divisor - (doubled % divisor < 0 ? 1 : 0);
}

template <size_t kAxes>
class PlaceCoder {
 public:
  static constexpr int kMostBits = 24;

  using Coordinates = std::array<int32_t, kAxes>;
  using Bits = std::array<uint8_t, kAxes>;  ///< of the differences of a place

  /// What is known of a place before it is told.
  struct Foreseen {
    Coordinates expected{};             ///< from 0 to 2^bits - 1
    std::array<int32_t, kAxes> bits{};  ///< sums over the places nearby
    int32_t nearby = 0;                 ///< how many these are
    size_t foretellers = 0;             ///< how many places it is the mean of; 3: or more

    void add(const Bits& of_place) {
      for (size_t axis = 0; axis < kAxes; ++axis) bits[axis] += of_place[axis];
      ++nearby;
    }
  };

  /// bits: of a coordinate, up to kMostBits.
  explicit PlaceCoder(int bits)
      : bits_(bits),
        odds_(makeOddsTable()),
        more_(kModels * kStates * kMostBits),
        weights_(kMostBits, freshWeights<kModels>()) {}

  int32_t most() const { return static_cast<int32_t>((uint32_t{1} << bits_) - 1); }

  /// Io: as of value_table_pass.hpp; a decision that does not count is false. place: of the
  /// encoder, from 0 to most(); becomes what a decoder has. Returns the bits of its differences.
  template <class Io>
  Bits pass(Io& io, const Foreseen& foreseen, Coordinates& place) {
    Bits told{};
    for (size_t axis = 0; axis < kAxes; ++axis) {
      const int32_t expected = foreseen.expected[axis];
      told[axis] = static_cast<uint8_t>(
          coordinate(io, statesOf(foreseen, told, axis), expected, place[axis]));
    }
    return told;
  }

 private:
  static constexpr size_t kModels = 4, kStates = 256;
  static constexpr int kModelledBits = 2;  ///< below the highest
  using States = std::array<size_t, kModels>;

  /// Of nothing the most.
  static size_t mean(int64_t sum, int64_t count, int64_t most) {
    return static_cast<size_t>(count == 0 ? most : std::min(most, (2 * sum + count) / (2 * count)));
  }

  /// told: the bits of the axes before.
  static States statesOf(const Foreseen& foreseen, const Bits& told, size_t axis) {
    int64_t here = 0, nearby = 0;
    for (size_t before = 0; before < axis; ++before) here += told[before];
    for (const int32_t bits : foreseen.bits) nearby += bits;
    const int64_t along = foreseen.bits[axis], count = foreseen.nearby;
    const size_t last = axis > 0 ? std::min<size_t>(told[axis - 1], 15) : 0;
    return {mean(2 * along, count, 63) + 64 * foreseen.foretellers,
            mean(here, static_cast<int64_t>(axis), 15) + 16 * mean(along, count, 15),
            mean(2 * nearby, kAxes * count, 63) + 64 * axis,
            last + 16 * mean(nearby, kAxes * count, 15)};
  }

  template <class Io>
  int coordinate(Io& io, const States& states, int32_t expected, int32_t& value) {
    const int32_t answer = value - expected;
    const auto magnitude = static_cast<uint32_t>(std::abs(answer));
    const int wanted = static_cast<int>(std::bit_width(magnitude));
    int bits = 0;
    while (bits < bits_ && isLonger(io, states, bits, wanted > bits)) ++bits;
    uint32_t told = bits > 0 ? 1 : 0;
    for (int position = bits - 2; position >= 0; --position) {
      const bool digit = (magnitude >> position) & 1;
      const bool modelled = told < 1u << kModelledBits;
      const bool bit =
          modelled ? io.decide(high_[static_cast<size_t>(bits)][told], digit) : io.even(digit);
      told = told << 1 | uint32_t{bit};
    }
    const auto difference = static_cast<int32_t>(told);
    const bool negative = told > 0 && io.even(answer < 0);
    value = (negative ? expected - difference : expected + difference) & most();
    return bits;
  }

  template <class Io>
  bool isLonger(Io& io, const States& states, int bits, bool answer) {
    const auto index = static_cast<size_t>(bits);
    std::array<AdaptiveBit*, kModels> models;
    for (size_t m = 0; m < kModels; ++m)
      models[m] = &more_[(m * kStates + states[m]) * kMostBits + index];
    Mixture<kModels> mixture(models, weights_[index], odds_);
    const bool bit = io.decideOf(mixture.zero(), answer);
    if (!io.stopped()) mixture.learn(bit);
    return bit;
  }

  int bits_;
  OddsTable odds_;
  std::vector<AdaptiveBit> more_;
  std::vector<MixtureWeights<kModels>> weights_;
  std::array<std::array<AdaptiveBit, 1 << kModelledBits>, kMostBits + 1> high_;
};

}  // namespace tetrakis::inline coder
