// SPDX-License-Identifier: Apache-2.0
// Lifting works on one-dimensional signals: the columns and the rows of a plane. A signal has two
// samples or more. Columns are mirrored about their first and their last sample; rows as well, or
// their ends are joined (lifting_steps.hpp). With 64-bit (wide) sums the results are exact; without
// them sums wrap modulo 2^32.
//
// The neighbours of the other parity change element t of a signal:
//
//   x[t] += round(sum_k w_k (x[t - 1 - 2k] + x[t + 1 + 2k]) / 2^shift)
#pragma once

#include <cstdint>
#include <span>

#include "codec/wavelet/lifting/lifting_steps.hpp"

namespace tetrakis::inline lifting {

/// Lifts all columns of a set of rows at once, in place: low rows stay at even indices, high ones
/// at odd indices.
void liftColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide);

/// Lifts single rows. The low half lies before the high half.
class RowLifting {
 public:
  RowLifting(uint32_t longest, Ends ends) : halves_(longest, ends) {}

  void analyse(int32_t* row, uint32_t length, FilterId id, bool wide);
  void synthesise(int32_t* row, uint32_t length, FilterId id, bool wide);
  /// Low values stay at even places, high ones at odd places, as in columns.
  void liftInPlace(std::span<int32_t> signal, FilterId id, Direction direction, bool wide);

 private:
  void run(FilterId id, Direction direction, bool wide);

  Halves<int32_t> halves_;
};

}  // namespace tetrakis::inline lifting
