// SPDX-License-Identifier: Apache-2.0
// This file cuts a coded component into packets and says what their bytes are worth. The account of
// the tracks is audited and thinned to its hull, errors are priced in the unit that all components
// share, and every packet states the quality that it leads to.
#pragma once

#include <functional>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "ratecontrol/audit.hpp"
#include "ratecontrol/coded_tracks.hpp"

namespace tetrakis::inline ratecontrol {

/// One component as the allocation sees it: its packets in their order, and the hull in a
/// distortion common to all components, whose points lie at ends of packets.
struct ComponentCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<Packet> packets;
};

/// What squared errors of a component's samples mean.
struct Pricing {
  double samples = 1;  ///< over which the stated quality is a mean
  /// A sum of squared errors in the distortion that all components share. It rises.
  std::function<double(double squares)> cost;
};

/// Several tracks are ordered among each other by their accounts (ratecontrol/track_order.hpp); a
/// single one is audited with `measure` first. The opening comes first, whatever it costs.
ComponentCurve curveOf(const CodedTracks& coded, const AuditScope& scope, const Measure& measure,
                       const Pricing& pricing);

}  // namespace tetrakis::inline ratecontrol
