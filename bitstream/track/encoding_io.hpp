// SPDX-License-Identifier: Apache-2.0
// EncodingIo is the encoder's side of PlanePass: it answers every decision from the true
// coefficients, codes the answer, and keeps the account of the squared error.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/track/reconstruction.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline track {

inline uint32_t magnitudeOf(int32_t value) {
  return static_cast<uint32_t>(std::abs(value));
}

inline double squared(double x) {
  return x * x;
}

/// The coefficients of a tier in a word, where all of them are in tier 0 unless there are tiers.
inline uint32_t membersOf(const BandPlan& plan, size_t tier, uint32_t row, uint32_t word) {
  if (plan.tiers == nullptr) return tier == 0 ? plan.shape.valid(word) : 0;
  return plan.tiers->members[tier * plan.shape.wordCells() + plan.shape.word(row, word)];
}

inline size_t tiersOf(const BandPlan& plan) {
  return plan.tiers == nullptr ? 1 : kPriorities;
}

/// Which bit-planes of a block, and of a band, hold a bit of some magnitude of a tier.
struct Occupancy {
  Occupancy(const BandPlan& plan, size_t tier, const std::vector<int32_t>& values)
      : blocks(size_t{(plan.shape.rows + Band::kBlockRows - 1) / Band::kBlockRows} *
                   plan.shape.words(),
               0) {
    const BandShape& shape = plan.shape;
    for (uint32_t row = 0; row < shape.rows; ++row) {
      uint32_t* to = blocks.data() + size_t{row / Band::kBlockRows} * shape.words();
      for (uint32_t word = 0; word < shape.words(); ++word) {
        const int32_t* from = values.data() + shape.cell(row, 32 * word);
        for (uint32_t todo = membersOf(plan, tier, row, word); todo != 0; todo &= todo - 1)
          to[word] |= magnitudeOf(from[std::countr_zero(todo)]);
      }
    }
    for (uint32_t block : blocks) band |= block;
  }
  std::vector<uint32_t> blocks;
  uint32_t band = 0;
};

class EncodingIo {
 public:
  using Plenty = EncodingIo&;
  static constexpr bool hasPlenty(size_t) { return false; }

  /// nothing: the account before the first byte.
  explicit EncodingIo(const RatePoint& nothing)
      : distortion_(nothing.distortion),
        best_(nothing.distortion),
        least_(nothing.distortion * 1e-12),
        squares_(nothing.squares()) {}

  /// What the next decisions are about.
  void select(const BandShape& shape, const BandSource& source, size_t tier,
              const Occupancy& occupancy) {
    words_ = shape.words();
    values_ = source.values.data();
    plain_ = source.weight;
    weight_ = source.weight * source.seen[tier];
    occupancy_ = &occupancy;
  }
  bool magnitudeBit(AdaptiveBit& model, size_t cell, int plane) {
    const bool bit = (magnitudeOf(values_[cell]) >> plane) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool refinedBit(AdaptiveBit& model, size_t cell, int plane) {
    return magnitudeBit(model, cell, plane);
  }
  bool signBit(AdaptiveBit& model, size_t cell, bool flip) {
    const bool negative = values_[cell] < 0;
    encoder_.encode(model, negative != flip);
    return negative;
  }
  bool blockBit(AdaptiveBit& model, uint32_t y, uint32_t x, int plane) {
    const bool bit = occupancy_->blocks[size_t{y} * words_ + x] >> plane != 0;
    encoder_.encode(model, bit);
    return bit;
  }
  bool groupBit(AdaptiveBit& model, size_t cell, int plane) {
    const bool bit = firstOfFour(cell, plane) < 4;
    encoder_.encode(model, bit);
    return bit;
  }
  bool placeBit(AdaptiveBit& model, size_t cell, uint32_t place_bit, int plane) {
    const bool bit = (firstOfFour(cell, plane) >> place_bit) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool bandBit(AdaptiveBit& model, int plane) {
    const bool bit = occupancy_->band >> plane != 0;
    encoder_.encode(model, bit);
    return bit;
  }
  bool stopped() const { return false; }
  void learned(size_t cell, uint32_t before, uint32_t after, int plane) {
    const double truth = magnitudeOf(values_[cell]);
    const double change = squared(truth - typicalMagnitude(after, plane)) -
                          squared(truth - typicalMagnitude(before, plane + 1));
    distortion_ += weight_ * change;
    squares_ += plain_ * change;
    if (distortion_ < best_) best_ = distortion_;
    dips_ |= distortion_ > kDip * best_ + least_;
  }
  /// The point reached now, with the dips since the last call. Only the end of a track is exact:
  /// the sums here are not.
  RatePoint point() {
    return {decidedBytes(), std::max(distortion_, least_), std::exchange(dips_, false),
            squares_ - distortion_};
  }
  uint64_t decidedBytes() const { return encoder_.decidedBytes(); }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  static constexpr double kDip =
      1.0015;  ///< 0.0065 dB: well inside the 0.03 dB that a prefix may fall

  /// 4 if none of the four reaches 2^plane.
  uint32_t firstOfFour(size_t cell, int plane) const {
    uint32_t i = 0;
    while (i < 4 && magnitudeOf(values_[cell + i]) >> plane == 0) ++i;
    return i;
  }

  RangeEncoder encoder_;
  double distortion_, best_;
  double least_;    ///< what these sums, which are not exact, may be off
  double squares_;  ///< whatever viewers see of them
  bool dips_ = false;
  uint32_t words_ = 0;
  const int32_t* values_ = nullptr;
  double weight_ = 1, plain_ = 1;
  const Occupancy* occupancy_ = nullptr;
};

}  // namespace tetrakis::inline track
