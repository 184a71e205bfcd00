// SPDX-License-Identifier: Apache-2.0
// Codes the heights of a plane as the tracks of its coefficients.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// Returns one track for each of regionsOf(). wavelet: from chooseWavelet(). Distortion is in
/// squared units of the heights, summed over the valid samples.
std::vector<EncodedTrack> encodeGeometry(const PlaneView<const int32_t>& heights,
                                         const WaveletHeader& wavelet, const TrackOptions& options);

}  // namespace tetrakis
