// SPDX-License-Identifier: Apache-2.0
// heightOptions() makes the options for the coefficients of heights from the options of an
// encoding.
#pragma once

#include <cstdint>

#include "codec/geometry/coefficients_encoder.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// inputs: with heights.
CoefficientOptions heightOptions(const EncodeInputs& inputs);

}  // namespace tetrakis::inline heights
