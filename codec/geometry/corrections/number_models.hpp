// SPDX-License-Identifier: Apache-2.0
// NumberModels tells how likely each answer to a question about a correction (correction_coder.hpp)
// is, from the numbers nearby (near_numbers.hpp).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bitstream/coder/mixture.hpp"
#include "codec/geometry/corrections/near_numbers.hpp"

namespace tetrakis::inline corrections {

// Each question asks whether a sample has one certain number or lies beyond it, so that the numbers
// nearby answer it as well as the decoded height does. Several models, each with contexts of its
// own, answer together (bitstream/coder/mixture.hpp): by the size of numbers nearby and by what the
// decoded height says, by which neighbours are alike, by where lines and planes through the
// neighbours lead, and by the number that divides the differences of the neighbours. Where all
// neighbours have the expected number one model answers alone: it is surer than a mixture can be,
// and takes a fraction of the time.

/// What is known of the size of a number beforehand.
struct NumberSize {
  static constexpr size_t kLevels = 64, kPlaces = 16;

  size_t level;  ///< of kLevels: how large numbers nearby are
  size_t place;  ///< of kPlaces: what the decoded height says

  size_t index() const { return level * kPlaces + place; }
};

/// The questions about a correction. Small magnitudes are asked for one by one, others by their
/// number of bits above these.
struct Question {
  static constexpr int32_t kOneByOne = 8;
  static constexpr size_t kMany = 41, kKinds = 5;

  size_t number;  ///< of kMany
  size_t kind;    ///< of kKinds
  int32_t about;  ///< the correction that it asks about

  static constexpr Question any() { return {0, 0, 0}; }
  static constexpr Question sign() { return {1, 1, 0}; }
  /// Is the magnitude more than this? magnitude: from 1 to kOneByOne - 1.
  static constexpr Question more(int32_t magnitude, bool negative) {
    const auto which = static_cast<size_t>(std::min(magnitude, 4));
    return {(negative ? 5 : 1) + which, negative ? 3u : 2u, negative ? -magnitude : magnitude};
  }
  /// Does the rest of the magnitude have more than `bits` bits? bits: from 1 to 31.
  static constexpr Question beyond(int bits, bool negative) {
    return {9 + static_cast<size_t>(bits), 4, negative ? -kOneByOne : kOneByOne};
  }
};

/// Models that answer questions about the numbers of samples.
class NumberModels {
 public:
  static constexpr size_t kModels = 7, kFarModels = 3;
  static constexpr size_t kFar = 3;  ///< neighbours whose numbers may be far off: W, N, NE

  NumberModels()
      : expected_(kSizes),
        size_(kSizes * Question::kMany),
        lines_(11 * 11 * 11 * Question::kKinds),
        plane_(21 * 8 * Question::kKinds),
        alike_(NearNumbers::kAlike * 9 * Question::kKinds),
        straight_(11 * 11 * Question::kKinds),
        around_(7 * 7 * 7 * 7 * Question::kKinds),
        multiples_((kMostDivisor + 1) * 2 * kSpreads * Question::kKinds),
        weights_(kSpreads * Question::kMany, freshWeights<kModels>()),
        far_size_(NumberSize::kLevels * kSizesOfFar * kFar),
        far_six_(NearNumbers::kSix * NumberSize::kLevels * kFar),
        far_alike_(NearNumbers::kAlike * kSizesOfFar * kFar),
        far_weights_(kSpreads * kFar, freshWeights<kFarModels>()) {}

  /// Asks whether the sample has a correction, where all neighbours have the expected number.
  AdaptiveBit& askExpected(NumberSize size) { return expected_[size.index()]; }

  /// Sets the contexts of a sample before the first question about it.
  void look(const NearNumbers& near, NumberSize size) {
    near_ = near;
    level_ = size.level;
    sizes_ = size.index();
    spread_ = std::min(near.spread, kSpreads - 1);
  }

  Mixture<kModels> ask(const Question& question) {
    const auto away = [&](int64_t number, int64_t most) {
      return static_cast<size_t>(std::clamp<int64_t>(number - question.about, -most, most) + most);
    };
    const size_t two = away(near_.west, 1) + 3 * away(near_.north, 1);
    const size_t lines =
        (away(near_.plane, 5) * 11 + away(near_.mean, 5)) * 11 + away(near_.slope, 5);
    const size_t around =
        ((away(near_.west, 3) * 7 + away(near_.north, 3)) * 7 + away(near_.north_west, 3)) * 7 +
        away(near_.north_east, 3);
    const bool multiple = near_.divisor > 0 && (near_.west - question.about) % near_.divisor == 0;
    const auto divisor = static_cast<size_t>(std::min(near_.divisor, kMostDivisor));
    const size_t kinds = Question::kKinds, kind = question.kind;
    return {{&size_[sizes_ * Question::kMany + question.number], &lines_[lines * kinds + kind],
             &plane_[(away(near_.plane, 10) * 8 + std::min<size_t>(spread_, 7)) * kinds + kind],
             &alike_[(near_.alike * 9 + two) * kinds + kind],
             &straight_[(away(near_.row, 5) * 11 + away(near_.column, 5)) * kinds + kind],
             &around_[around * kinds + kind],
             &multiples_[((divisor * 2 + multiple) * kSpreads + spread_) * kinds + kind]},
            weights_[spread_ * Question::kMany + question.number],
            odds_};
  }

  /// Asks whether the sample has the number of a neighbour, which is far off. which: of kFar.
  Mixture<kFarModels> askFar(size_t which, int64_t number) {
    const auto far = static_cast<uint64_t>(std::abs(number));
    const size_t bits = std::min<size_t>(static_cast<size_t>(std::bit_width(far)), kSizesOfFar - 1);
    const size_t six = near_.whichHave(number) * NumberSize::kLevels + level_;
    return {
        {&far_size_[(level_ * kSizesOfFar + bits) * kFar + which], &far_six_[six * kFar + which],
         &far_alike_[(near_.alike * kSizesOfFar + bits) * kFar + which]},
        far_weights_[spread_ * kFar + which],
        odds_};
  }

 private:
  static constexpr size_t kSizes = NumberSize::kLevels * NumberSize::kPlaces;
  static constexpr size_t kSpreads = 10, kSizesOfFar = 16;
  static constexpr int64_t kMostDivisor = 40;
  using Models = std::vector<AdaptiveBit>;

  Models expected_;   ///< by what is known of the size
  Models size_;       ///< by what is known of the size
  Models lines_;      ///< by where a plane, a mean and a slope lie
  Models plane_;      ///< by where a plane lies, and how rough it is
  Models alike_;      ///< by which neighbours are the same, and whether W and N have the number
  Models straight_;   ///< by where a row and a column go on to
  Models around_;     ///< by where the four neighbours lie
  Models multiples_;  ///< by what divides the neighbours' differences, and whether the number's
  std::vector<MixtureWeights<kModels>> weights_;
  Models far_size_;   ///< by the level, and how far off the number is
  Models far_six_;    ///< by which neighbours have the number, and the level
  Models far_alike_;  ///< by which neighbours are the same, and how far off the number is
  std::vector<MixtureWeights<kFarModels>> far_weights_;
  const OddsTable odds_ = makeOddsTable();
  NearNumbers near_;
  size_t level_ = 0, sizes_ = 0, spread_ = 0;
};

}  // namespace tetrakis::inline corrections
