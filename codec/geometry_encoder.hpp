// SPDX-License-Identifier: Apache-2.0
// Height field to geometry track.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/track_encoder.hpp"

namespace tetrakis {

/// heights: width * height integers, |height| < 2^27. valid: 1 valid, 0 void, one a height; empty:
/// all are valid. Distortion is in squared height units, summed over the valid samples. A complete
/// track is lossless; coding stops soon after `limit` bytes.
EncodedTrack encodeGeometry(std::span<const int32_t> heights, uint32_t width, uint32_t height,
                            uint64_t limit, std::span<const uint8_t> valid = {});

}  // namespace tetrakis
