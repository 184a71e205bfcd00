// SPDX-License-Identifier: Apache-2.0
// CorrectionEntropy estimates how many bytes corrections within a bound take, without coding them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline coding_choice {

/// The bits of answers whose counts stand in groups of so many.
inline double entropyOf(const std::vector<uint64_t>& counts, size_t group) {
  double bits = 0;
  for (size_t first = 0; first < counts.size(); first += group) {
    const std::span<const uint64_t> answers = std::span(counts).subspan(first, group);
    const auto all = std::accumulate(answers.begin(), answers.end(), uint64_t{0});
    for (const uint64_t count : answers) {
      if (count == 0) continue;
      const auto some = static_cast<double>(count);
      bits += some * portable::log2(static_cast<double>(all) / some);
    }
  }
  return bits;
}

/// The entropy of whether samples have a correction, of its number of bits and of its sign, by the
/// numbers of bits and the signs of the neighbours before, and by its hint. It is counted in one
/// pass, without the mixtures of models that code corrections. A search for the best cut scales it
/// by the bytes that the corrections of one cut really take.
class CorrectionEntropy {
 public:
  explicit CorrectionEntropy(uint32_t width) : above_(size_t{width} + 2), here_(above_) {}

  void nextRow() {
    std::swap(above_, here_);
    std::fill(here_.begin(), here_.end(), 0);
  }

  /// The correction of the sample in column x. hint: of activityHints().
  void add(uint32_t x, size_t hint, int32_t correction) {
    const int before[] = {here_[x], above_[x + 1], above_[x], above_[x + 2]};
    constexpr int kWeights[] = {2, 2, 1, 1}, kDigits[] = {27, 9, 3, 1};
    int nearby = 0, signs = 0;
    for (size_t i = 0; i < std::size(before); ++i) {
      nearby += kWeights[i] * std::abs(before[i]);
      signs += kDigits[i] * ((before[i] > 0) - (before[i] < 0));
    }
    const auto size = std::min(static_cast<size_t>(nearby), kNearby - 1);
    const auto pattern = static_cast<size_t>(std::abs(signs));
    const int bits = std::bit_width(magnitudeOf(correction));
    here_[x + 1] = static_cast<int8_t>(correction < 0 ? -bits : bits);
    ++any_[((std::min(size, kQuiet) * kHints + hint) * kSigns + pattern) * 2 + (bits > 0)];
    if (bits == 0) return;
    ++bits_[(size * kHints + hint) * kClasses + static_cast<size_t>(bits)];
    ++signs_[pattern * 2 + ((correction < 0) != (signs < 0))];
    digits_ += static_cast<uint64_t>(bits) - 1;
  }

  double bytes() const {
    return (static_cast<double>(digits_) + entropyOf(any_, 2) + entropyOf(bits_, kClasses) +
            entropyOf(signs_, 2)) /
           8;
  }

 private:
  static constexpr size_t kNearby = 24, kQuiet = 6, kHints = 6, kSigns = 41, kClasses = 33;
  using Counts = std::vector<uint64_t>;

  Counts any_ = Counts((kQuiet + 1) * kHints * kSigns * 2);
  Counts bits_ = Counts(kNearby * kHints * kClasses), signs_ = Counts(kSigns * 2);
  uint64_t digits_ = 0;
  std::vector<int8_t> above_, here_;  ///< numbers of bits, with signs, and margins on both sides
};

}  // namespace tetrakis::inline coding_choice
