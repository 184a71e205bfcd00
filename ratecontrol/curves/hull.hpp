// SPDX-License-Identifier: Apache-2.0
// lowerHull() thins an operational rate-distortion curve to its lower convex hull, which holds the
// only points at which a marginal analysis ever stops (thesis 6.3; Y. Shoham, A. Gersho 1988), and
// packetEnds() divides the bytes between two of these points into packets.
#pragma once

#include <span>
#include <vector>

#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline curves {

/// Hull vertices from the first to the last point, at least `growth` times the bytes so far (and
/// kLeastPacket) apart so that packet heads stay cheap.
std::vector<RatePoint> lowerHull(std::span<const RatePoint> points, double growth);

/// Bytes of the shortest packets. Shorter ones show first bytes sooner, and heads take more of
/// them.
inline constexpr uint64_t kLeastPacket = 24;

/// The ends of packets on the way from one vertex of the hull of `points` to another one: at `to`,
/// and around prefixes that dip, because a packet that dips counts only when complete and should be
/// short. RatePoint::dips is that of the packet.
std::vector<RatePoint> packetEnds(std::span<const RatePoint> points, const RatePoint& from,
                                  const RatePoint& to);

}  // namespace tetrakis::inline curves
