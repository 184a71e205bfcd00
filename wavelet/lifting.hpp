// SPDX-License-Identifier: Apache-2.0
// One-dimensional lifting of a bundle of signals that lie side by side: one lane is a row, many
// lanes are columns. Even and odd elements are kept apart, so that one loop, which compilers turn
// into SIMD, serves both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wavelet/lifting_filter.hpp"

namespace tetrakis {

class LiftingLine {
 public:
  static constexpr uint32_t kLanes = 32;  ///< most lanes: two cache lines of each element

  /// longest: most elements; lanes: most lanes that a resize() will ask for.
  LiftingLine(uint32_t longest, uint32_t lanes)
      : even_((longest / 2 + 1 + 2 * kMargin) * size_t{lanes}), odd_(even_.size()) {}

  void resize(uint32_t length, uint32_t lanes) {
    length_ = length;
    lanes_ = lanes;
  }
  uint32_t lows() const { return static_cast<uint32_t>(length_ - length_ / 2); }
  uint32_t highs() const { return static_cast<uint32_t>(length_ / 2); }
  int32_t* low(ptrdiff_t i) { return even_.data() + (i + kMargin) * lanes_; }
  int32_t* high(ptrdiff_t i) { return odd_.data() + (i + kMargin) * lanes_; }
  /// Element i of the signal before analysis, after synthesis.
  int32_t* sample(uint32_t i) { return i % 2 == 0 ? low(i / 2) : high(i / 2); }
  /// Element i of the bands side by side.
  int32_t* coefficient(uint32_t i) { return i < lows() ? low(i) : high(ptrdiff_t{i} - lows()); }

  /// Samples to coefficients and back, in place; signals of two samples or more, mirrored about
  /// their first and last. Sums are exact if wide, else they wrap modulo 2^32.
  void analyse(FilterId id, bool wide);
  void synthesise(FilterId id, bool wide);

 private:
  static constexpr ptrdiff_t kMargin = kMaxPairs;  // mirrored elements on either side

  template <class Sum, bool kAdd>
  void step(const LiftingStep& step, int shift, bool predicts);
  void mirrorLow(ptrdiff_t reach);
  void mirrorHigh(ptrdiff_t reach);

  std::vector<int32_t> even_, odd_;
  ptrdiff_t length_ = 0, lanes_ = 0;
};

}  // namespace tetrakis
