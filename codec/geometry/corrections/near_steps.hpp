// SPDX-License-Identifier: Apache-2.0
// NearSteps holds the exact steps before a sample that may equal its own: the step of a neighbour,
// or one that lies on a line or in a plane with neighbours. step_models.hpp makes contexts of them.
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

namespace tetrakis::inline corrections {

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

}  // namespace tetrakis::inline corrections
