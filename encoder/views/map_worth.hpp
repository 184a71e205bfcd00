// SPDX-License-Identifier: Apache-2.0
// mapsPay() decides whether maps of priorities are worth the bytes that they take in the header: it
// compares pictures of prefixes of a stream with maps and of one without.
#pragma once

#include <cstdint>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"

namespace tetrakis::inline views {

/// Bytes of the header that hold the maps of both components.
uint64_t bytesOfMaps(const Selection& selection);

/// Whether the cameras see fewer errors in prefixes of a stream with maps of priorities than in
/// those of a stream without maps, in the mean of half of the budget and all of it.
bool mapsPay(const EncodeInputs& inputs, const Selection& with, const Selection& without);

}  // namespace tetrakis::inline views
