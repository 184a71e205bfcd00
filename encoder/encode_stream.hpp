// SPDX-License-Identifier: Apache-2.0
// encodeStream() turns heights, a texture or both into a stream that meets the target of the
// options. It quantises, codes, orders the packets, keeps the packets that the target needs, and
// writes. Every stage takes a value and returns the next one, so that a stage can be tried again in
// another way.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline encoder {

/// The finished stream. inputs: have passed the checks of the C interface. TKS_USAGE: the options
/// ask for something impossible, or the caller stopped.
Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& inputs);

}  // namespace tetrakis::inline encoder
