// SPDX-License-Identifier: Apache-2.0
// decodeExactSteps() decodes exact corrections (exact_corrections.hpp), which turn decoded heights
// into whole steps again.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "base/plane.hpp"

namespace tetrakis::inline corrections {

/// Takes whole steps from sample `first` on, all of one row; 0 where samples are void.
using TakeSteps = std::function<void(size_t first, std::span<const int32_t> row)>;

/// Hands over the steps row by row, as far as they are decided. codeword: any prefix of a codeword
/// of encodeExactSteps() for the same heights, which are in units of 2^-fraction_bits steps; those
/// of a row may change once the row is handed over. Safe on any bytes.
void decodeExactSteps(std::span<const uint8_t> codeword, const PlaneView<const int32_t>& heights,
                      int fraction_bits, const TakeSteps& take);

}  // namespace tetrakis::inline corrections
