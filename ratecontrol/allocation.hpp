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

/// One component as the allocation sees it: hull points in a distortion common to all components,
/// and the RMSE that the packet ending at each point states. Of a component with several tracks the
/// packets are given instead, in their order; points lie at their ends.
struct TrackCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<double> rmse;       ///< one per point, of a single track
  std::vector<Packet> packets;    ///< of several tracks
};

/// Steepest slope first; within a track the order of the codeword. Equal slopes: geometry first.
std::vector<Packet> allocate(const std::array<TrackCurve, kTracks>& curves);

}  // namespace tetrakis
