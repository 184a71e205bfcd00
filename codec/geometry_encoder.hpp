// SPDX-License-Identifier: Apache-2.0
// Height field to geometry track.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/track_encoder.hpp"

namespace tetrakis {

/// heights: width * height integers, |height| < 2^26. Distortion is in squared height units, summed
/// over the samples. The complete track is lossless.
EncodedTrack encodeGeometry(std::span<const int32_t> heights, uint32_t width, uint32_t height);

}  // namespace tetrakis
