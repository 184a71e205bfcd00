// SPDX-License-Identifier: Apache-2.0
// One-dimensional lifting, along columns and along rows. Signals have two samples or more and are
// mirrored about their first and last. With 64-bit (wide) sums results are exact, else sums wrap
// modulo 2^32.
//
// Element t of a signal is changed by its neighbours of the other parity:
//
//   x[t] += round(sum_k w_k (x[t - 1 - 2k] + x[t + 1 + 2k]) / 2^shift)
#pragma once

#include <cstdint>

#include "wavelet/lifting_steps.hpp"

namespace tetrakis {

/// Lifts all columns of a set of rows at once, in place: low rows stay at even indices, high ones
/// at odd indices.
void liftColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide);

/// Lifts single rows. The low half lies before the high half.
class RowLifting {
 public:
  explicit RowLifting(uint32_t longest) : halves_(longest) {}

  void analyse(int32_t* row, uint32_t length, FilterId id, bool wide);
  void synthesise(int32_t* row, uint32_t length, FilterId id, bool wide);

 private:
  void run(FilterId id, Direction direction, bool wide);

  Halves<int32_t> halves_;
};

}  // namespace tetrakis
