// SPDX-License-Identifier: Apache-2.0
// Exact corrections turn decoded heights, which have fractions of steps, into the whole steps that
// they come from, row by row. All samples before one are exact then: the errors of the decoded
// heights are known there and foretell its own (error_forecast.hpp). The height and its foretold
// error add up to a sum. The correction counts steps from the one nearest to this sum, and is
// positive on the side of that step where the sum lies.
//
// A correction is told by questions (step_models.hpp): is there one, is it negative, is it more
// than 1, more than 2, and so on. Where samples were copied, turned or rounded to tens, a neighbour
// has the very step that one of them asks about. If its step lies farther off than these questions
// go, whether it is the sample's is asked before them.
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
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"
#include "codec/geometry/corrections/step_models.hpp"

namespace tetrakis::inline corrections {

/// The step nearest to a height plus its foretold error, halves up.
struct ForetoldStep {
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
    place = std::min(static_cast<size_t>(std::abs(beside)) * 2 * kStepPlaces >> fraction_bits,
                     kStepPlaces - 1);
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

/// Io: DecisionEncoding or DecisionDecoding (bitstream/coder/).
template <class Io>
class ExactCorrectionCoder {
 public:
  explicit ExactCorrectionCoder(Io& io) : io_(io) {}

  /// known: the correction, or any number in decoders. Where io has stopped the result means
  /// nothing.
  int32_t code(const NearSteps& near, size_t level, size_t place, int32_t known) {
    models_.look(near, level, place);
    if (const std::optional<int32_t> far = codeFar(near, known)) return *far;
    if (!decide(Question::any(), known != 0)) return 0;
    const bool negative = decide(Question::sign(), known < 0);
    const uint32_t magnitude = codeMagnitude(negative, magnitudeOf(known));
    return toSide(static_cast<int32_t>(magnitude), negative);
  }

 private:
  /// The correction, if it leads to the step of a neighbour that lies beyond the questions asked
  /// one after the other.
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

/// Codes all steps. heights: in units of 2^-fraction_bits steps. exact(sample): the whole steps
/// that the sample comes from, or any number in decoders. take(first, row): takes the steps row by
/// row, up to the first undecided one; 0 where samples are void.
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
