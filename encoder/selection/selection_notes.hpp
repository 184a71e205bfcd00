// SPDX-License-Identifier: Apache-2.0
// noteTaken() and noteOthers() tell the notes of an encoding which components were taken, and which
// were left for these.
#pragma once

#include <cstdint>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"

namespace tetrakis::inline selection {

/// Notes the components of a stream that holds so many bytes of the packets.
void noteTaken(const EncodeInputs& inputs, const Selection& taken, uint64_t payload_bytes);

/// Notes the components of a selection that lost within the budget, but for those that the better
/// one holds as well.
void noteOthers(const EncodeInputs& inputs, const Selection& better, const Selection& lost);

}  // namespace tetrakis::inline selection
