// SPDX-License-Identifier: Apache-2.0
// chooseExactCut() decides, by typical parts, whether heights to the last bit take fewer bytes as a
// cut of lossy coefficients with exact corrections behind it than as coefficients without fraction
// bits, and where to cut.
//
// The integer transform rounds each coefficient, which costs about a bit a sample where the heights
// themselves hold less, and it gains nothing from copies, planes that meet at edges, and heights
// rounded to tens. Corrections look at the exact neighbours of each sample.
#pragma once

#include <cstdint>
#include <optional>

#include "base/plane.hpp"

namespace tetrakis::inline coding_choice {

struct ExactCut {
  double mean_square;  ///< squared error of a sample, in steps, that the cut leaves
  double bytes;        ///< of it and of the corrections, as far as is known
  double worth;        ///< exactWorth() of these
  bool pays = false;   ///< it comes near the whole coefficients
};

/// The worth of bytes whose first `cut` bytes are a cut. Behind a cut the error falls row by row,
/// so that prefixes lose by early cuts: 5 % more for each halving of the cut against all bytes.
double exactWorth(double bytes, double cut);

/// Whether a way of this worth is as good as coefficients to the last bit that take `whole_bytes`
/// bytes, whose own prefixes lose about as much as by one halving.
bool isWorth(double worth, double whole_bytes);

/// The best cut that was looked at, by typical parts of the heights, whether or not it comes near
/// the whole coefficients to the last bit, which take `whole_bytes` bytes; nothing if these are too
/// few for any cut. heights: in steps. range_bits: of them.
std::optional<ExactCut> estimateExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                         uint64_t whole_bytes);

/// The same if the cut pays; else nothing.
std::optional<ExactCut> chooseExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                       uint64_t whole_bytes);

}  // namespace tetrakis::inline coding_choice
