// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the errors of decoded heights, as far as they are known, foretell the next one
// (docs/FORMAT.md, section 8.1, "Exact").
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// "l" of "Exact", without its largest value.
inline int levelOf(int64_t n) {
  const int bits = static_cast<int>(std::bit_width(static_cast<uint64_t>(n)));
  return n < 4 ? bits : 2 * bits - 3 + static_cast<int>(n >> (bits - 2) & 1);
}

class ErrorForecast {
 public:
  explicit ErrorForecast(const Plane& plane)
      : plane_(plane), errors_(plane.values.size()), missed_(plane.values.size()) {}

  /// "p" of the sample.
  int64_t look(int x, int y) {
    constexpr int kNeighbours[12][2] = {{-1, 0}, {0, -1},  {-1, -1}, {1, -1}, {-2, 0}, {0, -2},
                                        {2, -1}, {-2, -1}, {-1, -2}, {1, -2}, {-3, 0}, {0, -3}};
    p_ = 1 << 15;
    squares_ = 64;
    for (size_t i = 0; i < 12; ++i) {
      e_[i] = at(errors_, x + kNeighbours[i][0], y + kNeighbours[i][1]);
      p_ += f_[i] * e_[i];
      squares_ += e_[i] * e_[i];
    }
    p_ >>= 16;
    return p_;
  }
  /// "n" of the sample.
  int64_t missedNearby(int x, int y) const {
    return 2 * at(missed_, x - 1, y) + 2 * at(missed_, x, y - 1) + at(missed_, x - 1, y - 1) +
           at(missed_, x + 1, y - 1);
  }
  /// error: of the sample that it has looked at, of any size.
  void learn(int x, int y, int64_t error) {
    const int64_t e = std::clamp<int64_t>(error, -(1 << 15), 1 << 15), missed = e - p_;
    errors_[index(x, y)] = e;
    missed_[index(x, y)] = std::abs(missed);
    const int64_t h = missed * (1 << 12) / squares_;
    for (size_t i = 0; i < 12; ++i)
      f_[i] = std::clamp<int64_t>(f_[i] + ((h * e_[i]) >> 4), -(1 << 18), 1 << 18);
  }

 private:
  size_t index(int x, int y) const { return static_cast<size_t>(y) * plane_.width + x; }
  int64_t at(const std::vector<int64_t>& values, int x, int y) const {
    const bool there = x >= 0 && x < plane_.width && y >= 0 && plane_.isValid(x, y);
    return there ? values[index(x, y)] : 0;
  }

  const Plane& plane_;
  std::vector<int64_t> errors_, missed_;
  std::array<int64_t, 12> e_ = {}, f_ = {};
  int64_t p_ = 0, squares_ = 0;
};

}  // namespace tetrakis::reference
