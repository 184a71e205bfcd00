// SPDX-License-Identifier: Apache-2.0
// FacetRows predicts the next float of a surface of facets from the floats before it, in whole
// multiples of a unit (FacetUnit), so that both sides make the same predictions on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

namespace tetrakis::inline facets {

// FacetUnit turns floats into whole multiples of a unit, so that their sums are exact and the same
// on every machine. Digits of a float below the unit are cut off.

/// Places between a float and the middle of two.
inline constexpr size_t kFloatPlaces = 8;

/// The float nearest to a multiple of the unit.
struct NearestFloat {
  uint32_t order;  ///< orderOf() it
  bool below;      ///< the multiple lies below it
  size_t place;    ///< of kFloatPlaces, by how far it does
};

class FacetUnit {
 public:
  static constexpr int kLeastExponent = 1, kMostExponent = 254;

  /// exponent: the exponent field of the floats whose spacing is the unit.
  explicit FacetUnit(int exponent) : exponent_(exponent) {}

  /// The exponent for samples of such a magnitude. Sums of four of them have 63 bits; floats of a
  /// 2^36th of it are whole multiples.
  static int exponentFor(float largest) {
    return std::clamp(fieldOf(std::bit_cast<uint32_t>(largest)) - kMostShift, kLeastExponent,
                      kMostExponent);
  }

  /// Less than 2^60 in magnitude, whatever the sample is.
  int64_t multiplesOf(float sample) const {
    const auto bits = std::bit_cast<uint32_t>(sample);
    const bool normal = (bits >> (kMantissaBits - 1) & 0xff) != 0;
    const int64_t mantissa = (bits & (kHidden - 1)) | (normal ? kHidden : 0);
    const int shift = fieldOf(bits) - exponent_;
    const int64_t size = shift >= 0 ? mantissa << std::min(shift, kMostShift)
                                    : mantissa >> std::min(-shift, kMantissaBits);
    return bits >> 31 ? -size : size;
  }

  /// Half the distance from the sample to the next float of its binade, in units.
  int64_t halfSpacing(float sample) const {
    const int shift = fieldOf(std::bit_cast<uint32_t>(sample)) - exponent_ - 1;
    return shift >= 0 ? int64_t{1} << std::min(shift, kMostShift) : 0;
  }

  /// Halves go to the larger magnitude.
  NearestFloat nearest(int64_t multiples) const {
    if (multiples == 0) return {0, false, 0};
    const bool negative = multiples < 0;
    const auto size = static_cast<uint64_t>(std::abs(multiples));
    const int shift = std::max(static_cast<int>(std::bit_width(size)) - kMantissaBits,
                               kLeastExponent - exponent_);
    if (shift <= 0) return {ordered(size << -shift, exponent_ + shift, negative), negative, 0};
    const uint64_t mantissa = (size + (uint64_t{1} << (shift - 1))) >> shift;
    const auto off = static_cast<int64_t>(size - (mantissa << shift));
    const uint64_t place = static_cast<uint64_t>(std::abs(off)) * 2 * kFloatPlaces >> shift;
    return {ordered(mantissa, exponent_ + shift, negative), (off < 0) != negative,
            std::min(static_cast<size_t>(place), kFloatPlaces - 1)};
  }

 private:
  static constexpr int kMantissaBits = 24, kMostShift = 36;
  static constexpr uint32_t kHidden = 1u << (kMantissaBits - 1);

  /// The exponent field; denormal floats have the spacing of those of field 1.
  static int fieldOf(uint32_t bits) {
    return std::max(static_cast<int>(bits >> (kMantissaBits - 1) & 0xff), 1);
  }

  /// mantissa: from 2^23 to 2^24, or below where the exponent is 1. Beyond the largest float: that.
  static uint32_t ordered(uint64_t mantissa, int exponent, bool negative) {
    constexpr uint64_t kLargest = 0x7f7fffff;
    const uint64_t bits = (static_cast<uint64_t>(exponent - 1) << (kMantissaBits - 1)) + mantissa;
    const auto finite = static_cast<uint32_t>(std::min(bits, kLargest));
    return negative ? ~finite : finite;
  }

  int exponent_;
};

// A facet is a part of a surface whose samples lie in one plane, or in rows on one line each, but
// for what the rounding of floats leaves: a triangle of a surface between points, a cell of an
// enlarged raster. Its samples go on from those before them. There are thirteen ways to go on, each
// from one sample by the slope between two others, which lie apart as it and the new sample do. On
// one facet all of them lead to the same place; beside an edge those that do not cross it are
// right, and mostly these are the ways that were right at the neighbours.

inline constexpr size_t kWays = 13;

/// A lane of bits for each way, so that as many sets as there are neighbours add up.
using WaySet = uint64_t;
inline constexpr size_t kLane = 4;

/// Where some ways agree that a sample lies.
struct FacetPrediction {
  int64_t multiples;    ///< the mean of where they lead
  size_t way;           ///< the first of them
  size_t agreeing;      ///< how many they are
  size_t right_before;  ///< a bit for each of six neighbours: there the first of them was right
};

class FacetRows {
 public:
  static constexpr size_t kNeighbours = 6;

  explicit FacetRows(uint32_t width) {
    for (auto& row : known_) row.assign(width + 2 * kMargin, kMissing);
    for (auto& row : right_) row.resize(width + 2 * kMargin);
  }

  void nextRow() {
    std::rotate(known_.begin(), known_.end() - 1, known_.end());
    std::fill(known_[0].begin(), known_[0].end(), kMissing);
    std::rotate(right_.begin(), right_.end() - 1, right_.end());
    std::fill(right_[0].begin(), right_[0].end(), WaySet{0});
  }

  /// Looks at the sample in column x. Where a neighbour is missing, as at voids, the next one on
  /// the way to the sample stands in; `otherwise`, if there is neither W nor N.
  void look(uint32_t x, int64_t otherwise) {
    const size_t i = x + kMargin;
    goOn(i, otherwise);
    right_near_ = {right_[0][i - 1], right_[1][i],     right_[1][i - 1],
                   right_[1][i + 1], right_[0][i - 2], right_[2][i]};
    right_counts_ = std::accumulate(right_near_.begin(), right_near_.end(), WaySet{0});
    left_ = (1u << kWays) - 1;
  }

  /// Predictions are left that do not agree with those before.
  bool more() const { return left_ != 0; }

  /// The likeliest of these, by at how many neighbours its first way was right.
  FacetPrediction next() {
    size_t best = 0, most = 0;
    for (size_t way = 0; way < kWays; ++way) {
      const size_t likely = (left_ >> way & 1) * (1 + (right_counts_ >> kLane * way & kLaneMask));
      if (likely <= most) continue;
      most = likely;
      best = way;
    }
    const Nearness near(ways_[best]);
    int64_t sum = 0, count = 0;
    for (size_t way = 0; way < kWays; ++way) {
      const int64_t apart = ways_[way] - ways_[best];
      const bool agrees = (left_ >> way & 1) != 0 && near.holds(apart);
      left_ &= ~(unsigned{agrees} << way);
      sum += agrees ? apart : 0;
      count += agrees;
    }
    FacetPrediction prediction{ways_[best] + sum / count, best, static_cast<size_t>(count), 0};
    for (size_t k = 0; k < kNeighbours; ++k)
      prediction.right_before |= static_cast<size_t>(right_near_[k] >> kLane * best & 1) << k;
    return prediction;
  }

  /// The sample that it has looked at is known.
  void put(uint32_t x, int64_t multiples) {
    known_[0][x + kMargin] = multiples;
    right_[0][x + kMargin] = waysTo(multiples);
  }

  /// The ways that lead to the sample that it has looked at; 0: none.
  WaySet waysTo(int64_t multiples) const {
    const Nearness near(multiples);
    WaySet ways = 0;
    for (size_t way = 0; way < kWays; ++way)
      ways |= WaySet{near.holds(ways_[way] - multiples)} << kLane * way;
    return ways;
  }

 private:
  static constexpr int64_t kMissing = std::numeric_limits<int64_t>::min();
  static constexpr size_t kMargin = 4;
  static constexpr WaySet kLaneMask = (1 << kLane) - 1;

  /// What lies two to four spacings of floats apart from somewhere, at most.
  class Nearness {
   public:
    explicit Nearness(int64_t from) : most_((std::abs(from) >> 22) + 1) {}
    bool holds(int64_t apart) const { return -most_ <= apart && apart <= most_; }

   private:
    int64_t most_;
  };

  void goOn(size_t i, int64_t otherwise) {
    const auto &here = known_[0], &above = known_[1], &upper = known_[2];
    const auto known = [](int64_t one, int64_t other) { return one == kMissing ? other : one; };
    const int64_t w = known(here[i - 1], known(above[i], otherwise)), n = known(above[i], w);
    const int64_t nw = known(above[i - 1], n), ne = known(above[i + 1], n);
    const int64_t ww = known(here[i - 2], w), nn = known(upper[i], n);
    const int64_t nww = known(above[i - 2], nw), nnw = known(upper[i - 1], nw);
    const int64_t nee = known(above[i + 2], ne), nne = known(upper[i + 1], ne);
    const int64_t nnww = known(upper[i - 2], nnw), nnee = known(upper[i + 2], nne);
    const int64_t far_west = known(upper[i - 4], nnww), far_east = known(upper[i + 4], nnee);
    ways_ = {w + n - nw,          w + w - ww,   n + n - nn,     n + ne - nne,
             w + ne - n,          w + nw - nww, n + nw - nnw,   nw + nw - nnww,
             ne + ne - nnee,      w + nee - ne, n + nww - nnww, nww + nww - far_west,
             nee + nee - far_east};
  }

  std::array<std::vector<int64_t>, 3> known_;  ///< of this row and those above it, in units
  std::array<std::vector<WaySet>, 3> right_;   ///< the ways that were right there
  std::array<int64_t, kWays> ways_ = {};       ///< where they lead
  std::array<WaySet, kNeighbours> right_near_ = {};
  WaySet right_counts_ = 0;  ///< at how many neighbours each way was right
  unsigned left_ = 0;        ///< ways of which no prediction has come yet, a bit for each
};

}  // namespace tetrakis::inline facets
