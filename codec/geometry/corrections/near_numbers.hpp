// SPDX-License-Identifier: Apache-2.0
// NumberRows keeps the numbers of the samples before one, row by row, and NearNumbers tells those
// near it, from which the coder of corrections (correction_coder.hpp) expects the next number.
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

/// Numbers near a sample, counted from one that the sample is expected to have; its correction
/// counts from there as well. Any of them may be its own, and so may a number that lies on a line
/// or in a plane with neighbours.
struct NearNumbers {
  int64_t west = 0, north = 0, north_west = 0, north_east = 0, second_west = 0, second_north = 0;
  int64_t plane = 0;            ///< W + N - NW
  int64_t mean = 0;             ///< of W and N
  int64_t slope = 0;            ///< N, and on as from NNE to NE
  int64_t row = 0, column = 0;  ///< 2 W - WW, 2 N - NN
  size_t alike = kAllAlike;     ///< which of them are the same, kAlike patterns
  size_t spread = 0;            ///< bits of the differences W - NW, N - NW and N - NE
  int64_t divisor = 0;  ///< the largest of all differences of W from the others; 0: none differs

  static constexpr size_t kAlike = 512, kAllAlike = kAlike - 1;

  /// All of the numbers are the expected one.
  bool expectedEverywhere() const { return alike == kAllAlike && west == 0; }

  /// Which of six neighbours have a number: a bit for each.
  static constexpr size_t kSix = 64;
  size_t whichHave(int64_t number) const {
    size_t which = 0, bit = 0;
    for (const int64_t one : {west, north, north_west, north_east, second_west, second_north})
      which |= size_t{one == number} << bit++;
    return which;
  }
};

class NumberRows {
 public:
  explicit NumberRows(uint32_t width) {
    for (Row& row : rows_) row.assign(width + kMargins, kNone);
  }

  void nextRow() {
    std::rotate(rows_.begin(), rows_.end() - 1, rows_.end());
    std::fill(rows_[0].begin(), rows_[0].end(), kNone);
  }

  void put(uint32_t x, int32_t number) { rows_[0][x + kLeft] = number; }

  /// The numbers near the sample in column x, counted from `expected`, in the opposite direction if
  /// `backwards`. Where a neighbour is missing, as at voids, the next neighbour on the way to the
  /// sample stands in for it; the expected number itself, if there is neither W nor N.
  NearNumbers near(uint32_t x, int32_t expected, bool backwards) const {
    if (allNearAre(x, expected)) return {};
    const auto &here = rows_[0], &above = rows_[1], &upper = rows_[2];
    const size_t i = x + kLeft;
    const auto counted = [&](int64_t number, int64_t else_counted) {
      if (number == kNone) return else_counted;
      return backwards ? expected - number : number - expected;
    };
    const int64_t north_or_none = counted(above[i], kNone);
    const int64_t w = counted(here[i - 1], north_or_none == kNone ? 0 : north_or_none);
    const int64_t n = north_or_none == kNone ? w : north_or_none;
    const int64_t nw = counted(above[i - 1], n), ne = counted(above[i + 1], n);
    const int64_t ww = counted(here[i - 2], w), nn = counted(upper[i], n);
    const int64_t nne = counted(upper[i + 1], ne);
    const int64_t nnw = counted(upper[i - 1], nw), nww = counted(above[i - 2], nw);
    NearNumbers near{w,          n,          nw, ne, ww, nn, w + n - nw, (w + n) >> 1, n + ne - nne,
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
  /// Whether no neighbour is missing, and each has the number: so it is in most places.
  bool allNearAre(uint32_t x, int64_t number) const {
    const auto &here = rows_[0], &above = rows_[1], &upper = rows_[2];
    const size_t i = x + kLeft;
    int64_t differ = 0;
    for (const int64_t other : {here[i - 1], here[i - 2], above[i - 2], above[i - 1], above[i],
                                above[i + 1], upper[i - 1], upper[i], upper[i + 1]})
      differ |= other ^ number;
    return differ == 0;
  }

  using Row = std::vector<int64_t>;
  static constexpr int64_t kNone = std::numeric_limits<int64_t>::min();
  static constexpr uint32_t kLeft = 2, kMargins = kLeft + 1;

  std::array<Row, 3> rows_;  ///< this row and those above it
};

}  // namespace tetrakis::inline corrections
