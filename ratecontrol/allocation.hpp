// SPDX-License-Identifier: Apache-2.0
// Marginal allocation (thesis 6.3): all packets of all tracks in the order of their slopes. Walked
// backwards it is the resource reduction that gives up the packet that costs least per byte; every
// prefix is jointly allocated. The order does not depend on any budget.
#pragma once

#include <array>
#include <vector>

#include "bitstream/packet.hpp"
#include "bitstream/track_encoder.hpp"

namespace tetrakis {

/// One component as the allocation sees it: its packets in their order, and the hull in a
/// distortion common to all components, whose points lie at ends of packets.
struct TrackCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<Packet> packets;
};

/// Steepest slope first; within a component the order of its packets. Equal slopes: geometry first.
std::vector<Packet> allocate(const std::array<TrackCurve, kTracks>& curves);

}  // namespace tetrakis
