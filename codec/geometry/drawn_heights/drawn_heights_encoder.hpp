// SPDX-License-Identifier: Apache-2.0
// encodeDrawnHeights() codes heights in steps as a drawing, which decodeDrawnHeights() decodes.
#pragma once

#include <cstdint>
#include <optional>

#include "base/plane.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline drawn_heights {

/// Codes all heights without loss, whole. Nothing if there are more than kMostDrawnValues values.
/// Distortion is in squared units of the heights, summed over the valid samples.
std::optional<EncodedTrack> encodeDrawnHeights(const PlaneView<const int32_t>& heights);

}  // namespace tetrakis::inline drawn_heights
