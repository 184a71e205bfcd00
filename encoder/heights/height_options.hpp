// SPDX-License-Identifier: Apache-2.0
// The options of an encoding, for the coefficients of its heights.
#pragma once

#include <cstdint>

#include "codec/geometry/geometry_encoder.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// Heights of more samples are coded in regions unless the caller says otherwise.
inline constexpr uint64_t kOneRegionHeights = 1025 * 1025;

/// inputs: with heights.
CoefficientOptions heightOptions(const EncodeInputs& inputs);

}  // namespace tetrakis::inline heights
