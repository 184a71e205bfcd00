// SPDX-License-Identifier: Apache-2.0
// The order of the packets of a component that is coded in regions: marginal allocation
// (thesis 6.3) among its tracks, in the component's own distortion. What is cheap to improve
// anywhere comes first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"

namespace tetrakis {

/// Bytes of the first track that come before, and behind, everything else.
struct FixedBytes {
  uint64_t opening = 0, closing = 0;
};

struct OrderedTracks {
  std::vector<Packet> packets;  ///< their quality is not set
  /// Bytes sent and distortion of the whole component: at the beginning and after each packet.
  std::vector<RatePoint> points;
};

OrderedTracks orderTracks(Component component, std::span<const EncodedTrack> tracks,
                          const FixedBytes& fixed);

}  // namespace tetrakis
