// SPDX-License-Identifier: Apache-2.0
// liftedSamples() adds bridges to the mask of valid samples: voids in single holes and narrow gaps
// that have coefficients as samples have, and whose decoded values are thrown away. Lifting stops
// at voids, so such holes would cut a plane into pieces too short for its filters. The mask and a
// number in the stream header, the reach, tell which voids are bridged.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bit_plane.hpp"

namespace tetrakis::inline wavelet {

/// The reach that bridges every void.
inline constexpr uint8_t kBridgeAll = 255;

/// Returns the mask of the samples that are lifted: the closing of the valid ones by squares of
/// that reach (codec/wavelet/morphology.hpp). Nothing: all are. reach: 0 bridges nothing,
/// kBridgeAll everything.
SharedBits liftedSamples(const SharedBits& valid, uint8_t reach);
std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach);

}  // namespace tetrakis::inline wavelet
