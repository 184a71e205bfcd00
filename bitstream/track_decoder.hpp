// SPDX-License-Identifier: Apache-2.0
// Decodes any prefix of a track's codeword into what it says about the coefficients.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/track.hpp"

namespace tetrakis {

/// Runs the passes of `plan` over `codeword`, up to the last one of a band that is needed, until
/// its bytes decide nothing more. Bands that are not needed are decoded as far as they come before
/// that: there is one codeword. Safe on any bytes: work is bounded by planes * coefficients, memory
/// by the plan.
TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword);

}  // namespace tetrakis
