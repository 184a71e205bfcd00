// SPDX-License-Identifier: Apache-2.0
// This file goes the whole way from inputs to a stream: it quantises, codes, orders the packets,
// meets the target and writes. Every stage takes a value and returns the next one.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline encoder {

/// The finished stream. inputs: have passed the checks of the C interface. TKS_USAGE: what is asked
/// for is not possible, or the caller stopped.
Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& inputs);

}  // namespace tetrakis::inline encoder
