// SPDX-License-Identifier: Apache-2.0
// Height field to geometry tracks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// heights: width * height integers. wavelet: from chooseWavelet(). valid: 1 valid, 0 void, one a
/// height; empty: all are valid. Distortion is in squared height units, summed over the samples.
std::vector<EncodedTrack> encodeGeometry(std::span<const int32_t> heights, uint32_t width,
                                         uint32_t height, const WaveletHeader& wavelet,
                                         const TrackOptions& options,
                                         std::span<const uint8_t> valid = {});

}  // namespace tetrakis
