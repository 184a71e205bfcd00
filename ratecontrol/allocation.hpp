// SPDX-License-Identifier: Apache-2.0
// Marginal allocation (thesis 6.3): all packets of all tracks in the order of their slopes. Walked
// backwards it is the resource reduction that gives up the packet that costs least per byte; every
// prefix is jointly allocated. The order does not depend on any budget.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// One component as the allocation sees it: its packets in their order, and the hull in a
/// distortion common to all components, whose points lie at ends of packets.
struct ComponentCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<Packet> packets;
};

/// Steepest slope first; within a component the order of its packets. Equal slopes: geometry first.
std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves);

/// The same bytes in fewer packets: neighbours of one track become one, as long as it takes less
/// than two steps of stated quality (1.5 dB). Packets that count only when whole stay as they are.
std::vector<Packet> joinNeighbours(std::span<const Packet> packets);

}  // namespace tetrakis
