// SPDX-License-Identifier: Apache-2.0
// curveOf() cuts a coded component into packets and computes the worth of their bytes. It audits
// the account of the tracks, thins it to its hull, and states in every packet the quality that it
// leads to. Errors of one component beside those of the other are the business of
// ratecontrol/allocation/pair_errors.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "ratecontrol/curves/audit.hpp"
#include "ratecontrol/curves/coded_tracks.hpp"
#include "ratecontrol/curves/track_order.hpp"

namespace tetrakis::inline curves {

/// One component as the allocation sees it: its packets in their order, and the hull of its mean
/// squared errors, whose points lie at ends of packets.
struct ComponentCurve {
  std::vector<RatePoint> points;  ///< from {0, ...}; convex; fewer than two: no packets
  std::vector<Packet> packets;
  size_t opened = 0;  ///< the first point behind the opening
  /// For a large component in one track: the points of its account behind the opening, which are
  /// ends of passes. A point within a pass takes longer to decode. Else empty.
  std::vector<RatePoint> passes = {};
};

/// How packets are priced by the errors of a component, and how the component is divided into
/// packets.
struct Pricing {
  double samples = 1;   ///< squared errors are divided by it: packets state means
  double floor = 0;     ///< bytes that lower the mean squared error below it are worth nothing
  bool shared = false;  ///< there is another component, whose packets may come between the parts of
                        ///< a long packet: such packets are divided
  TrackOrder order = TrackOrder::kSlopes;  ///< of several tracks among each other
};

/// Squared error of the samples decoded from the first bytes of the packets; without packets, of
/// the only track. Asked for rising bytes.
using MeasurePackets = std::function<double(const std::vector<Packet>& packets, uint64_t bytes)>;

/// Makes the curve of a component. Several tracks are ordered among each other by their accounts
/// (orderTracks()), and the joint account is audited with `measure`, as the account of a single
/// track is. The opening comes first, whatever it costs.
ComponentCurve curveOf(const CodedTracks& coded, const AuditScope& scope,
                       const MeasurePackets& measure, const Pricing& pricing);

}  // namespace tetrakis::inline curves
