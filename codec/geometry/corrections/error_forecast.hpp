// SPDX-License-Identifier: Apache-2.0
// ErrorForecast foretells the error of the decoded height of the next sample, row by row, from the
// errors of its neighbours, which are known because the samples there are exact:
//
//   foretold = sum of weights * errors of twelve neighbours before it
//
// The weights learn from each sample by normalised least mean squares (B. Widrow, M. Hoff 1960;
// J. Nagumo, A. Noda 1967): they follow a filter that oscillates as well as a plane that a cut has
// smoothed away. All of it is in integers: errors in units of the heights, weights of 2^-16.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace tetrakis::inline corrections {

/// Levels of a size, two an octave.
inline size_t levelOf(uint64_t size) {
  const auto bits = static_cast<size_t>(std::bit_width(size));
  return bits < 3 ? bits : 2 * bits - 3 + (size >> (bits - 2) & 1);
}

class ErrorForecast {
 public:
  explicit ErrorForecast(uint32_t width) {
    for (Row& row : errors_) row.resize(width + kMargins);
    for (std::vector<uint32_t>& row : missed_) row.resize(width + kMargins);
  }

  /// Begins a row, whose samples have no error unless one is learnt.
  void nextRow() {
    std::rotate(errors_.begin(), errors_.end() - 1, errors_.end());
    std::fill(errors_[0].begin(), errors_[0].end(), 0);
    std::swap(missed_[0], missed_[1]);
    std::fill(missed_[0].begin(), missed_[0].end(), 0);
  }

  /// Computes the forecast for the sample in column x from its neighbours.
  void look(uint32_t x) {
    const size_t i = x + kLeft;
    const auto &here = errors_[0], &above = errors_[1], &upper = errors_[2];
    near_ = {here[i - 1],  above[i],     above[i - 1], above[i + 1], here[i - 2], upper[i],
             above[i + 2], above[i - 2], upper[i - 1], upper[i + 1], here[i - 3], errors_[3][i]};
    int64_t sum = 1 << 15;
    for (size_t k = 0; k < near_.size(); ++k) sum += int64_t{weights_[k]} * near_[k];
    foretold_ = static_cast<int32_t>(sum >> 16);
    const auto &left = missed_[0], &up = missed_[1];
    missed_nearby_ = 2 * (left[i - 1] + up[i]) + up[i - 1] + up[i + 1];
  }
  int32_t foretold() const { return foretold_; }

  /// The level of the error by which forecasts nearby have missed.
  size_t missedLevel() const { return levelOf(missed_nearby_); }

  /// Learns the error of the sample that look() was called for.
  void learn(uint32_t x, int64_t error) {
    constexpr int64_t kRate = 1 << 12, kQuiet = 64, kLargestWeight = 1 << 18;
    const auto clamped = static_cast<int32_t>(std::clamp<int64_t>(error, -kLargest, kLargest));
    const int32_t missed = clamped - foretold_;
    errors_[0][x + kLeft] = clamped;
    missed_[0][x + kLeft] = static_cast<uint32_t>(std::abs(missed));
    int64_t power = kQuiet;
    for (const int32_t e : near_) power += int64_t{e} * e;
    const auto gain = static_cast<int32_t>(missed * kRate / power);
    for (size_t k = 0; k < near_.size(); ++k) {
      const int64_t weight = weights_[k] + ((int64_t{gain} * near_[k]) >> 4);
      weights_[k] = static_cast<int32_t>(std::clamp(weight, -kLargestWeight, kLargestWeight));
    }
  }

 private:
  using Row = std::vector<int32_t>;
  static constexpr int64_t kLargest = 1 << 15;
  static constexpr uint32_t kLeft = 3, kMargins = kLeft + 2;

  std::array<Row, 4> errors_;                    ///< of this row and of those above it
  std::array<std::vector<uint32_t>, 2> missed_;  ///< by forecasts of this row and the one above
  std::array<int32_t, 12> near_ = {};
  std::array<int32_t, 12> weights_ = {};
  int32_t foretold_ = 0;
  uint32_t missed_nearby_ = 0;
};

}  // namespace tetrakis::inline corrections
