// SPDX-License-Identifier: Apache-2.0
// Exact corrections turn decoded heights, which have fractions of steps, into the whole steps that
// they come from, row by row. All samples before one are exact then, so that the errors of the
// decoded heights are known there; those of its neighbours foretell its own:
//
//   foretold = sum of weights * errors of W, N, NW, NE, WW and NN
//
// The weights learn from each sample by normalised least mean squares (B. Widrow, M. Hoff 1960;
// J. Nagumo, A. Noda 1967): they follow a filter that oscillates as well as a plane that a cut has
// smoothed away. The height and its foretold error add up to a sum. The correction counts steps
// from the one nearest to this sum, and is positive on the side of that step where the sum lies.
// The contexts are how near the sum is to the middle of two steps, and the size of the errors
// nearby.
//
// All of it is in integers: errors in units of the heights, weights in units of 2^-16.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline corrections {

/// What the errors of decoded heights before a sample say of its own.
class ErrorForecast {
 public:
  static constexpr size_t kLevels = 20;

  explicit ErrorForecast(uint32_t width)
      : rows_{Row(width + kMargins), Row(width + kMargins), Row(width + kMargins)} {}

  /// Begins a row, whose samples have no error unless one is learnt.
  void nextRow() {
    std::rotate(rows_.begin(), rows_.end() - 1, rows_.end());
    std::fill(rows_[0].begin(), rows_[0].end(), 0);
  }

  /// Looks at the neighbours of the sample in column x.
  void look(uint32_t x) {
    const auto &here = rows_[0], &above = rows_[1];
    const size_t i = x + kLeft;
    near_ = {here[i - 1], above[i], above[i - 1], above[i + 1], here[i - 2], rows_[2][i]};
    int64_t sum = 0;
    for (size_t k = 0; k < near_.size(); ++k) sum += weights_[k] * near_[k];
    foretold_ = static_cast<int32_t>((sum + (1 << 15)) >> 16);
  }
  int32_t foretold() const { return foretold_; }

  /// The size of the errors nearby: two levels an octave.
  size_t level() const {
    const auto size = [&](size_t k) { return static_cast<uint32_t>(std::abs(near_[k])); };
    const uint32_t sum = 2 * (size(0) + size(1)) + size(2) + size(3);
    const auto bits = static_cast<size_t>(std::bit_width(sum));
    return bits < 3 ? bits : std::min(2 * bits - 3 + (sum >> (bits - 2) & 1), kLevels - 1);
  }

  /// Learns the error of the sample that it has looked at.
  void learn(uint32_t x, int64_t error) {
    constexpr int64_t kRate = 1 << 12, kQuiet = 64, kLargestWeight = 1 << 18;
    const auto clamped = static_cast<int32_t>(std::clamp<int64_t>(error, -kLargest, kLargest));
    rows_[0][x + kLeft] = clamped;
    int64_t power = kQuiet;
    for (const int64_t e : near_) power += e * e;
    const int64_t gain = (clamped - int64_t{foretold_}) * kRate / power;
    for (size_t k = 0; k < near_.size(); ++k) {
      const int64_t weight = weights_[k] + ((gain * near_[k]) >> 4);
      weights_[k] = std::clamp(weight, -kLargestWeight, kLargestWeight);
    }
  }

 private:
  using Row = std::vector<int32_t>;
  static constexpr int64_t kLargest = 1 << 15;
  static constexpr uint32_t kLeft = 2, kMargins = kLeft + 1;

  std::array<Row, 3> rows_;  ///< errors of this row, the one above and the one above that
  std::array<int32_t, 6> near_ = {};
  std::array<int64_t, 6> weights_ = {};
  int32_t foretold_ = 0;
};

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

/// Io: as of CorrectionCoder.
template <class Io>
class ExactCorrectionCoder {
 public:
  explicit ExactCorrectionCoder(Io& io) : io_(io) {}

  /// known: the correction, or anything in decoders. Where io has stopped the result means nothing.
  int32_t code(size_t level, size_t place, int32_t known) {
    if (!io_.more(any_[level][place], known, 0) || io_.stopped()) return 0;
    int bits = 1;
    while (bits < kMostBits && io_.more(more_[level][static_cast<size_t>(bits)], known, bits))
      ++bits;
    const size_t size = std::min<size_t>(static_cast<size_t>(bits), sign_.size()) - 1;
    const bool negative = io_.negative(sign_[size][place], known, false);
    if (io_.stopped()) return 0;
    const uint32_t magnitude = digits_.code(io_, known, bits);
    return static_cast<int32_t>(negative ? 0u - magnitude : magnitude);
  }

 private:
  static constexpr int kMostBits = 32;
  template <size_t kFirst, size_t kSecond>
  using Models = std::array<std::array<AdaptiveBit, kSecond>, kFirst>;

  Io& io_;
  Models<ErrorForecast::kLevels, ForetoldStep::kPlaces> any_;  ///< whether there is a correction
  Models<ErrorForecast::kLevels, kMostBits> more_;
  Models<4, ForetoldStep::kPlaces> sign_;
  CorrectionDigits digits_;
};

/// heights: in units of 2^-fraction_bits steps. exact(sample): the whole steps that it comes from,
/// or anything in decoders. take(first, row): takes these row by row, up to the first undecided
/// one; 0 where samples are void.
template <class Io, class ExactStep, class TakeRow>
void codeExactSteps(const PlaneView<const int32_t>& heights, int fraction_bits, Io& io,
                    const ExactStep& exact, const TakeRow& take) {
  ErrorForecast forecast(heights.width);
  ExactCorrectionCoder<Io> coder(io);
  std::vector<int32_t> row(heights.width);
  for (uint32_t y = 0; y < heights.height; ++y) {
    const size_t first = size_t{y} * heights.width;
    forecast.nextRow();
    for (uint32_t x = 0; x < heights.width; ++x) {
      row[x] = 0;
      if (!heights.valid[first + x]) continue;
      const int32_t height = heights.data[first + x];
      forecast.look(x);
      const ForetoldStep step(height, forecast.foretold(), fraction_bits);
      const int32_t known = step.correctionTo(exact(first + x));
      row[x] = step.corrected(coder.code(forecast.level(), step.place, known));
      if (io.stopped()) return take(first, std::span<const int32_t>(row).first(x));
      const auto whole = static_cast<int32_t>(static_cast<uint32_t>(row[x]) << fraction_bits);
      forecast.learn(x, int64_t{whole} - height);
    }
    take(first, std::span<const int32_t>(row));
  }
}

}  // namespace tetrakis::inline corrections
