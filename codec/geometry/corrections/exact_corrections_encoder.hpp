// SPDX-License-Identifier: Apache-2.0
// encodeExactSteps() codes exact corrections (exact_corrections.hpp), which turn decoded heights
// into whole steps again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline corrections {

/// The codeword that leads from decoded heights, in units of 2^-fraction_bits steps, to the steps.
/// Those of void samples are not coded.
std::vector<uint8_t> encodeExactSteps(std::span<const int32_t> steps,
                                      const PlaneView<const int32_t>& heights, int fraction_bits);

}  // namespace tetrakis::inline corrections
