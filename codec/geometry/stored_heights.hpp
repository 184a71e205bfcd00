// SPDX-License-Identifier: Apache-2.0
// Stores heights sample by sample where coding them would take more bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline geometry {

/// Returns the samples at multiples of 2^level. Their steps are those nearest to the samples, and
/// corrections restore the samples. A sample that has no byte yet is that of step 0. bytes: any
/// prefix of what is stored of a geometry with header.stored(). valid: of the whole plane.
DecodedHeights decodeStored(const GeometryHeader& header, std::span<const uint8_t> bytes,
                            Mask valid, int level);

/// Returns how many bytes storing the valid samples takes.
uint64_t storedBytes(const tks_heights& heights, size_t valid_samples);

/// Returns the codeword of the valid samples.
std::vector<uint8_t> storeSamples(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline geometry
