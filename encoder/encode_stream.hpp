// SPDX-License-Identifier: Apache-2.0
// The whole way from inputs to a stream: quantise, code, order the packets, meet the target, write.
// Every stage takes a value and returns the next one.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "encoder/inputs.hpp"

namespace tetrakis {

/// The finished stream. inputs: have passed the checks of the C interface. TKS_USAGE: what is asked
/// for is not possible, or the caller stopped.
Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& inputs);

}  // namespace tetrakis
