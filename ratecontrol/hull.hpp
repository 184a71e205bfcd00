// SPDX-License-Identifier: Apache-2.0
// Lower convex hull of an operational rate-distortion curve: the only points that a marginal
// analysis ever stops at (thesis 6.3; Y. Shoham, A. Gersho 1988).
#pragma once

#include <span>
#include <vector>

#include "bitstream/track_encoder.hpp"

namespace tetrakis {

/// Hull vertices from the first to the last point, at least `growth` times the bytes so far (and
/// kLeastPacket) apart so that packet heads stay cheap. A vertex dips if any point it skips does.
std::vector<RatePoint> lowerHull(std::span<const RatePoint> points, double growth);

inline constexpr uint64_t kLeastPacket = 24;

}  // namespace tetrakis
