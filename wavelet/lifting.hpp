// SPDX-License-Identifier: Apache-2.0
// One-dimensional lifting, along columns and along rows. Signals have two samples or more and are
// mirrored about their first and last. With 64-bit (wide) sums results are exact, else sums wrap
// modulo 2^32.
//
// Element t of a signal is changed by its neighbours of the other parity:
//
//   x[t] += round(sum_k w_k (x[t - 1 - 2k] + x[t + 1 + 2k]) / 2^shift)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wavelet/lifting_kernel.hpp"

namespace tetrakis {

/// Where the mirror image of place p lies in a signal of n >= 2 samples.
inline ptrdiff_t mirror(ptrdiff_t p, ptrdiff_t n) {
  if (p >= 0 && p < n) return p;
  const ptrdiff_t period = 2 * (n - 1);
  p = ((p % period) + period) % period;
  return std::min(p, period - p);
}

/// Rows of equal length at equal distances.
struct RowSet {
  int32_t* first;
  size_t pitch;    ///< from one row to the next, in values
  uint32_t count;  ///< rows
  uint32_t width;  ///< values of a row that take part
};

/// Lifts all columns of a set of rows at once, in place: low rows stay at even indices, high ones
/// at odd indices. The steps follow each other at a distance of a few rows, so that every row is
/// read from memory once.
void liftColumns(const RowSet& rows, FilterId id, Direction direction, bool wide);

/// Lifts single rows. The low half lies before the high half.
class RowLifting {
 public:
  explicit RowLifting(uint32_t longest)
      : even_(longest / 2 + 1 + 2 * kMargin), odd_(even_.size()) {}

  void analyse(int32_t* row, uint32_t length, FilterId id, bool wide);
  void synthesise(int32_t* row, uint32_t length, FilterId id, bool wide);

 private:
  static constexpr ptrdiff_t kMargin = kMaxPairs;  // mirrored elements on either side

  int32_t* low() { return even_.data() + kMargin; }
  int32_t* high() { return odd_.data() + kMargin; }
  void run(ptrdiff_t length, FilterId id, Direction direction, bool wide);

  std::vector<int32_t> even_, odd_;
};

}  // namespace tetrakis
