// SPDX-License-Identifier: Apache-2.0
// orderTracks() orders the packets of a component that is coded in regions. The finest order is the
// marginal allocation (thesis 6.3) among the component's tracks, in its own distortion: the
// cheapest improvement anywhere comes first. Then the packets of a region and of its neighbours are
// strewn over the stream, and a receiver that fetches a window by ranges takes hundreds of them, or
// the bytes between. Two coarser orders keep them together; docs/EXPERIMENTS.md has their cost in
// prefixes.
#pragma once

#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "ratecontrol/curves/coded_tracks.hpp"

namespace tetrakis::inline curves {

enum class TrackOrder {
  kSlopes,   ///< steepest first: the best prefixes
  kClasses,  ///< by classes of slopes, two an octave, and track by track within one
  kTracks,   ///< track by track, whatever the slopes: the base, then region by region
};

struct OrderedTracks {
  std::vector<Packet> packets;  ///< their quality is not set
  /// Bytes sent and distortion of the whole component: at the beginning and after each packet.
  std::vector<RatePoint> points;
};

/// The opening comes first and corrections last, whatever their slopes.
OrderedTracks orderTracks(const CodedTracks& coded, TrackOrder by);

}  // namespace tetrakis::inline curves
