// SPDX-License-Identifier: Apache-2.0
// Coefficients and the corrections behind them, as tracks with their accounts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline heights {

/// corrections: the codeword of each part. One codeword lies at the end of the first track, several
/// are tracks of their own (bitstream/stream/correction_tracks.hpp). They take off the error that
/// all the others leave, up to the squared error corrected_to.
std::vector<EncodedTrack> tracksWithCorrections(std::vector<EncodedTrack> tracks,
                                                std::span<const std::vector<uint8_t>> corrections,
                                                double corrected_to);

}  // namespace tetrakis::inline heights
