// SPDX-License-Identifier: Apache-2.0
// StepModels tells how likely each answer to a question about an exact correction
// (exact_corrections.hpp) is, from the exact steps nearby, which ExactRows keeps.
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

#include "bitstream/coder/mixture.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"

namespace tetrakis::inline corrections {

// NearSteps holds the exact steps before a sample that may equal its own: the step of a neighbour,
// or one that lies on a line or in a plane with neighbours.

/// Steps near a sample, counted from one of them; corrections count from it as well.
struct NearSteps {
  int64_t west, north, north_west, north_east, second_west, second_north;
  int64_t plane;        ///< W + N - NW
  int64_t mean;         ///< of W and N
  int64_t slope;        ///< N, and on as from NNE to NE
  int64_t row, column;  ///< 2 W - WW, 2 N - NN
  size_t alike;         ///< which of them are the same, kAlike patterns
  size_t spread;        ///< bits of the differences W - NW, N - NW and N - NE
  int64_t divisor;      ///< the largest of all differences of W from the others; 0: none differs

  static constexpr size_t kAlike = 512;

  /// Which of six neighbours have a step: a bit for each.
  static constexpr size_t kSix = 64;
  size_t whichHave(int64_t step) const {
    size_t which = 0, bit = 0;
    for (const int64_t one : {west, north, north_west, north_east, second_west, second_north})
      which |= size_t{one == step} << bit++;
    return which;
  }
};

class ExactRows {
 public:
  explicit ExactRows(uint32_t width) {
    for (Row& row : rows_) row.assign(width + kMargins, kNone);
  }

  void nextRow() {
    std::rotate(rows_.begin(), rows_.end() - 1, rows_.end());
    std::fill(rows_[0].begin(), rows_[0].end(), kNone);
  }

  void put(uint32_t x, int32_t step) { rows_[0][x + kLeft] = step; }

  /// The steps near the sample in column x, as counted from `from`, in the opposite direction if
  /// `backwards`. Where a neighbour is missing, as at voids, the next neighbour on the way to the
  /// sample stands in for it; `from` itself, if there is neither W nor N.
  NearSteps near(uint32_t x, int32_t from, bool backwards) const {
    const auto &here = rows_[0], &above = rows_[1], &upper = rows_[2];
    const size_t i = x + kLeft;
    const auto counted = [&](int64_t step, int64_t else_counted) {
      if (step == kNone) return else_counted;
      return backwards ? from - step : step - from;
    };
    const int64_t north_or_none = counted(above[i], kNone);
    const int64_t w = counted(here[i - 1], north_or_none == kNone ? 0 : north_or_none);
    const int64_t n = north_or_none == kNone ? w : north_or_none;
    const int64_t nw = counted(above[i - 1], n), ne = counted(above[i + 1], n);
    const int64_t ww = counted(here[i - 2], w), nn = counted(upper[i], n);
    const int64_t nne = counted(upper[i + 1], ne);
    const int64_t nnw = counted(upper[i - 1], nw), nww = counted(above[i - 2], nw);
    NearSteps near{w,          n,          nw, ne, ww, nn, w + n - nw, (w + n) >> 1, n + ne - nne,
                   2 * w - ww, 2 * n - nn, 0,  0,  0};
    size_t bit = 0;
    for (const bool same :
         {w == nw, w == n, n == ne, n == nn, w == ww, n == nw, ne == nne, nw == nww, nw == nnw})
      near.alike |= size_t{same} << bit++;
    near.spread = static_cast<size_t>(std::bit_width(
        static_cast<uint64_t>(std::abs(w - nw) + std::abs(n - nw) + std::abs(n - ne))));
    for (const int64_t other : {nw, n, ne, ww, nn, nne, nnw, nww}) {
      if (near.divisor == 1) break;
      near.divisor = std::gcd(near.divisor, w - other);
    }
    return near;
  }

 private:
  using Row = std::vector<int64_t>;
  static constexpr int64_t kNone = std::numeric_limits<int64_t>::min();
  static constexpr uint32_t kLeft = 2, kMargins = kLeft + 1;

  std::array<Row, 3> rows_;  ///< this row and those above it
};

// StepModels answers questions about a correction. Each question asks whether a sample has one
// certain step or lies beyond it, so that exact steps nearby answer it as well as the decoded
// height does. Several models, each with contexts of its own, answer together
// (bitstream/coder/mixture.hpp): by how well errors were foretold, by which neighbours are alike,
// by where lines and planes through the neighbours lead, and by the number that divides the
// differences of the neighbours.

/// Places between a step and the middle of two (exact_corrections.hpp).
inline constexpr size_t kStepPlaces = 8;

/// The questions about a correction. Small magnitudes are asked for one by one, others by their
/// number of bits above these.
struct Question {
  static constexpr int32_t kOneByOne = 8;
  static constexpr size_t kMany = 18, kKinds = 5;

  size_t number;  ///< of kMany
  size_t kind;    ///< of kKinds
  int32_t step;   ///< the correction that it asks about

  static constexpr Question any() { return {0, 0, 0}; }
  static constexpr Question sign() { return {1, 1, 0}; }
  /// Is the magnitude more than this? magnitude: from 1 to kOneByOne - 1.
  static constexpr Question more(int32_t magnitude, bool negative) {
    const auto which = static_cast<size_t>(std::min(magnitude, 4));
    return {(negative ? 5 : 1) + which, negative ? 3u : 2u, negative ? -magnitude : magnitude};
  }
  /// Does the rest of the magnitude have more than `bits` bits?
  static constexpr Question beyond(int bits, bool negative) {
    return {9 + static_cast<size_t>(std::min(bits, 8)), 4, negative ? -kOneByOne : kOneByOne};
  }
};

/// Models that answer questions about the steps of samples.
class StepModels {
 public:
  static constexpr size_t kModels = 7, kFarModels = 3;
  static constexpr size_t kFar = 3;  ///< neighbours whose steps may be far off: W, N, NE

  StepModels()
      : size_(kSizes * Question::kMany),
        lines_(11 * 11 * 11 * Question::kKinds),
        plane_(21 * 8 * Question::kKinds),
        alike_(NearSteps::kAlike * 9 * Question::kKinds),
        straight_(11 * 11 * Question::kKinds),
        around_(7 * 7 * 7 * 7 * Question::kKinds),
        multiples_((kMostDivisor + 1) * 2 * kSpreads * Question::kKinds),
        weights_(kSpreads * Question::kMany, freshWeights<kModels>()),
        far_size_(ErrorForecast::kLevels * kSizesOfFar * kFar),
        far_six_(NearSteps::kSix * ErrorForecast::kLevels * kFar),
        far_alike_(NearSteps::kAlike * kSizesOfFar * kFar),
        far_weights_(kSpreads * kFar, freshWeights<kFarModels>()) {}

  /// Sets the contexts of a sample before the first question about it.
  void look(const NearSteps& near, size_t level, size_t place) {
    near_ = near;
    level_ = level;
    sizes_ = level * kStepPlaces + place;
    spread_ = std::min(near.spread, kSpreads - 1);
  }

  Mixture<kModels> ask(const Question& question) {
    const auto away = [&](int64_t step, int64_t most) {
      return static_cast<size_t>(std::clamp<int64_t>(step - question.step, -most, most) + most);
    };
    const size_t two = away(near_.west, 1) + 3 * away(near_.north, 1);
    const size_t lines =
        (away(near_.plane, 5) * 11 + away(near_.mean, 5)) * 11 + away(near_.slope, 5);
    const size_t around =
        ((away(near_.west, 3) * 7 + away(near_.north, 3)) * 7 + away(near_.north_west, 3)) * 7 +
        away(near_.north_east, 3);
    const bool multiple = near_.divisor > 0 && (near_.west - question.step) % near_.divisor == 0;
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

  /// Asks whether the sample has the step of a neighbour, which is far off. which: of kFar.
  Mixture<kFarModels> askFar(size_t which, int64_t step) {
    const size_t bits =
        std::min<size_t>(static_cast<size_t>(std::bit_width(static_cast<uint64_t>(std::abs(step)))),
                         kSizesOfFar - 1);
    const size_t six = near_.whichHave(step) * ErrorForecast::kLevels + level_;
    return {
        {&far_size_[(level_ * kSizesOfFar + bits) * kFar + which], &far_six_[six * kFar + which],
         &far_alike_[(near_.alike * kSizesOfFar + bits) * kFar + which]},
        far_weights_[spread_ * kFar + which],
        odds_};
  }

 private:
  static constexpr size_t kSizes = ErrorForecast::kLevels * kStepPlaces;
  static constexpr size_t kSpreads = 10, kSizesOfFar = 16;
  static constexpr int64_t kMostDivisor = 40;
  using Models = std::vector<AdaptiveBit>;

  Models size_;       ///< by the size of the error, and the place between two steps
  Models lines_;      ///< by where a plane, a mean and a slope lie
  Models plane_;      ///< by where a plane lies, and how rough it is
  Models alike_;      ///< by which neighbours are the same, and whether W and N have the step
  Models straight_;   ///< by where a row and a column go on to
  Models around_;     ///< by where the four neighbours lie
  Models multiples_;  ///< by what divides the neighbours' differences, and whether the step's
  std::vector<MixtureWeights<kModels>> weights_;
  Models far_size_;   ///< by the size of the error, and how far off the step is
  Models far_six_;    ///< by which neighbours have the step, and the size of the error
  Models far_alike_;  ///< by which neighbours are the same, and how far off the step is
  std::vector<MixtureWeights<kFarModels>> far_weights_;
  const OddsTable odds_ = makeOddsTable();
  NearSteps near_ = {};
  size_t level_ = 0, sizes_ = 0, spread_ = 0;
};

}  // namespace tetrakis::inline corrections
