// SPDX-License-Identifier: Apache-2.0
// writeStream() writes the finished stream of a selection: the header, its index, and the packets
// that fit the budget. It notes the plans of what it has written as taken.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"

namespace tetrakis::inline selection {

/// How many bytes the header of a stream of these packets takes if the stream is not lossless.
uint64_t headerBytesOf(const EncodeInputs& inputs, const Selection& selection);

/// Whether all samples come back, with the header and all packets within the budget.
bool isLossless(const EncodeInputs& inputs, const Selection& selection);

/// TKS_USAGE: the budget is too small for the header.
Result<std::vector<uint8_t>> writeStream(const EncodeInputs& inputs, const Selection& selection);

}  // namespace tetrakis::inline selection
