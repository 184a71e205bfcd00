// SPDX-License-Identifier: Apache-2.0
// Exact corrections turn decoded heights, which have fractions of steps, into the whole steps that
// they come from, row by row. All samples before one are exact then: the errors of the decoded
// heights are known there and foretell its own (error_forecast.hpp). The height and its foretold
// error add up to a sum. The correction counts steps from the one nearest to this sum, and is
// positive on the side of that step where the sum lies.
//
// A correction is told by questions: is there one, is it negative, is it more than 1, more than 2,
// and so on. Each question asks whether the sample is one certain step or lies beyond it, so that
// exact steps nearby answer it as well as the decoded height does: where samples were copied,
// turned or rounded to tens, a neighbour has that very step. If a neighbour's step lies farther off
// than these questions go, whether it is the sample's is asked before them. Several models, each
// with contexts of its own, answer together (bitstream/coder/mixture.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/mixture.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"
#include "codec/geometry/corrections/near_steps.hpp"

namespace tetrakis::inline corrections {

/// The step nearest to a height with its foretold error, halves up.
struct ForetoldStep {
  static constexpr size_t kPlaces = 8;

  int32_t step;
  bool below;    ///< the height lies below it
  size_t place;  ///< between the step and the middle of two

  ForetoldStep(int32_t height, int32_t foretold, int fraction_bits) {
    const int some = fraction_bits > 0;
    const auto sum =
        static_cast<int32_t>(static_cast<uint32_t>(height) + static_cast<uint32_t>(foretold));
    step = (sum >> fraction_bits) + ((sum >> (fraction_bits - some)) & some);
    const uint32_t whole = static_cast<uint32_t>(step) << fraction_bits;
    const auto beside = static_cast<int32_t>(static_cast<uint32_t>(sum) - whole);
    below = beside < 0;
    place =
        std::min(static_cast<size_t>(std::abs(beside)) * 2 * kPlaces >> fraction_bits, kPlaces - 1);
  }

  int32_t correctionTo(int32_t exact) const {
    return toSide(static_cast<int32_t>(static_cast<uint32_t>(exact) - static_cast<uint32_t>(step)),
                  below);
  }
  int32_t corrected(int32_t correction) const {
    return static_cast<int32_t>(static_cast<uint32_t>(step) +
                                static_cast<uint32_t>(toSide(correction, below)));
  }
};

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
  /// Has the rest of the magnitude more than so many bits?
  static constexpr Question beyond(int bits, bool negative) {
    return {9 + static_cast<size_t>(std::min(bits, 8)), 4, negative ? -kOneByOne : kOneByOne};
  }
};

/// Models that answer questions about the steps of samples.
class StepModels {
 public:
  static constexpr size_t kModels = 6, kFarModels = 3;
  static constexpr size_t kFar = 3;  ///< neighbours whose steps may be far off: W, N, NE

  StepModels()
      : size_(kSizes * Question::kMany),
        lines_(11 * 11 * 11 * Question::kKinds),
        plane_(21 * 8 * Question::kKinds),
        alike_(NearSteps::kAlike * 9 * Question::kKinds),
        straight_(11 * 11 * Question::kKinds),
        around_(7 * 7 * 7 * 7 * Question::kKinds),
        weights_(kSpreads * Question::kMany, freshWeights<kModels>()),
        far_size_(ErrorForecast::kLevels * kSizesOfFar * kFar),
        far_six_(NearSteps::kSix * ErrorForecast::kLevels * kFar),
        far_alike_(NearSteps::kAlike * kSizesOfFar * kFar),
        far_weights_(kSpreads * kFar, freshWeights<kFarModels>()) {}

  /// What is known of a sample before it is asked about.
  void look(const NearSteps& near, size_t level, size_t place) {
    near_ = near;
    level_ = level;
    sizes_ = level * ForetoldStep::kPlaces + place;
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
    const size_t kinds = Question::kKinds, kind = question.kind;
    return {{&size_[sizes_ * Question::kMany + question.number], &lines_[lines * kinds + kind],
             &plane_[(away(near_.plane, 10) * 8 + std::min<size_t>(spread_, 7)) * kinds + kind],
             &alike_[(near_.alike * 9 + two) * kinds + kind],
             &straight_[(away(near_.row, 5) * 11 + away(near_.column, 5)) * kinds + kind],
             &around_[around * kinds + kind]},
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
  static constexpr size_t kSizes = ErrorForecast::kLevels * ForetoldStep::kPlaces;
  static constexpr size_t kSpreads = 10, kSizesOfFar = 16;
  using Models = std::vector<AdaptiveBit>;

  Models size_;      ///< by the size of the error, and the place between two steps
  Models lines_;     ///< by where a plane, a mean and a slope lie
  Models plane_;     ///< by where a plane lies, and how rough it is
  Models alike_;     ///< by which neighbours are the same, and whether W and N have the step
  Models straight_;  ///< by where a row and a column go on to
  Models around_;    ///< by where the four neighbours lie
  std::vector<MixtureWeights<kModels>> weights_;
  Models far_size_;   ///< by the size of the error, and how far off the step is
  Models far_six_;    ///< by which neighbours have the step, and the size of the error
  Models far_alike_;  ///< by which neighbours are the same, and how far off the step is
  std::vector<MixtureWeights<kFarModels>> far_weights_;
  const OddsTable odds_ = makeOddsTable();
  NearSteps near_ = {};
  size_t level_ = 0, sizes_ = 0, spread_ = 0;
};

/// Io: DecisionEncoding or DecisionDecoding (bitstream/coder/).
template <class Io>
class ExactCorrectionCoder {
 public:
  explicit ExactCorrectionCoder(Io& io) : io_(io) {}

  /// known: the correction, or anything in decoders. Where io has stopped the result means nothing.
  int32_t code(const NearSteps& near, size_t level, size_t place, int32_t known) {
    models_.look(near, level, place);
    if (const std::optional<int32_t> far = codeFar(near, known)) return *far;
    if (!decide(Question::any(), known != 0)) return 0;
    const bool negative = decide(Question::sign(), known < 0);
    const uint32_t magnitude = codeMagnitude(negative, magnitudeOf(known));
    return toSide(static_cast<int32_t>(magnitude), negative);
  }

 private:
  /// The correction, if it leads to the step of a neighbour that one question after the other would
  /// not ask for.
  std::optional<int32_t> codeFar(const NearSteps& near, int32_t known) {
    const std::array<int64_t, StepModels::kFar> steps = {near.west, near.north, near.north_east};
    for (size_t which = 0; which < steps.size(); ++which) {
      const int64_t step = steps[which];
      const auto end = steps.begin() + static_cast<ptrdiff_t>(which);
      if (std::abs(step) <= Question::kOneByOne || std::find(steps.begin(), end, step) != end)
        continue;
      const auto correction = static_cast<int32_t>(static_cast<uint32_t>(step));
      if (decide(models_.askFar(which, step), known == correction)) return correction;
    }
    return {};
  }

  uint32_t codeMagnitude(bool negative, uint32_t known) {
    for (int32_t size = 1; size < Question::kOneByOne; ++size) {
      const auto magnitude = static_cast<uint32_t>(size);
      if (!decide(Question::more(size, negative), known > magnitude)) return magnitude;
    }
    const uint32_t known_rest = known - (Question::kOneByOne - 1);
    const int known_bits = std::bit_width(known_rest);
    int bits = 1;
    while (bits < kMostBits && decide(Question::beyond(bits, negative), known_bits > bits)) ++bits;
    uint32_t rest = 1;
    for (int position = bits - 2; position >= 0; --position) {
      const bool bit = (known_rest >> position) & 1;
      rest =
          2 * rest + (position == bits - 2 ? io_.decide(high_[static_cast<size_t>(bits) - 1], bit)
                                           : io_.even(bit));
    }
    return rest + (Question::kOneByOne - 1);
  }

  bool decide(const Question& question, bool known) { return decide(models_.ask(question), known); }
  template <size_t kModels>
  bool decide(Mixture<kModels> mixture, bool known) {
    const bool answer = io_.decideOf(mixture.zero(), known);
    mixture.learn(answer);
    return answer;
  }

  static constexpr int kMostBits = 32;

  Io& io_;
  StepModels models_;
  std::array<AdaptiveBit, kMostBits> high_;  ///< the second digit of a rest, by its bits
};

/// heights: in units of 2^-fraction_bits steps. exact(sample): the whole steps that it comes from,
/// or anything in decoders. take(first, row): takes these row by row, up to the first undecided
/// one; 0 where samples are void.
template <class Io, class ExactStep, class TakeRow>
void codeExactSteps(const PlaneView<const int32_t>& heights, int fraction_bits, Io& io,
                    const ExactStep& exact, const TakeRow& take) {
  ErrorForecast forecast(heights.width);
  ExactRows rows(heights.width);
  ExactCorrectionCoder<Io> coder(io);
  std::vector<int32_t> row(heights.width);
  for (uint32_t y = 0; y < heights.height; ++y) {
    const size_t first = size_t{y} * heights.width;
    forecast.nextRow();
    rows.nextRow();
    for (uint32_t x = 0; x < heights.width; ++x) {
      row[x] = 0;
      if (!heights.valid[first + x]) continue;
      const int32_t height = heights.data[first + x];
      forecast.look(x);
      const ForetoldStep step(height, forecast.foretold(), fraction_bits);
      const int32_t known = step.correctionTo(exact(first + x));
      const NearSteps near = rows.near(x, step.step, step.below);
      row[x] = step.corrected(coder.code(near, forecast.level(), step.place, known));
      if (io.stopped()) return take(first, std::span<const int32_t>(row).first(x));
      const auto whole = static_cast<int32_t>(static_cast<uint32_t>(row[x]) << fraction_bits);
      forecast.learn(x, int64_t{whole} - height);
      rows.put(x, row[x]);
    }
    take(first, std::span<const int32_t>(row));
  }
}

}  // namespace tetrakis::inline corrections
