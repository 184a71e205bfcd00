// SPDX-License-Identifier: Apache-2.0
// placedPackets() lists the packets of a front index, each with its place in the stream and with
// the worth of one of its bytes to the viewers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"
#include "ratecontrol/receiver/sighting.hpp"

namespace tetrakis::inline receiver {

constexpr double kOpening = std::numeric_limits<double>::infinity();

/// What a byte of a packet is worth; kOpening: it comes before all others.
struct PacketWorth {
  double all = 0;    ///< to all sightings together
  double now = 0;    ///< to the first of them
  double slope = 0;  ///< as the index states it

  PacketWorth least(const PacketWorth& other) const {
    return {std::min(all, other.all), std::min(now, other.now), std::min(slope, other.slope)};
  }
};

/// A packet of the index.
struct PlacedPacket {
  size_t number = 0;
  uint64_t begin = 0, end = 0;  ///< bytes of the stream
  PacketWorth worth;
  bool is_correction = false;  ///< in a track of its own
};

/// What helps more comes first; of what helps alike the greater slope.
bool helpsMore(const PacketWorth& a, const PacketWorth& b);

/// All packets in the stream's order; the first begins at byte `begin`. TKS_CORRUPT where the index
/// names a track that there is not.
Result<std::vector<PlacedPacket>> placedPackets(const StreamHeader& header, uint64_t begin,
                                                std::span<const WeightedSighting> sightings);

/// Packets whose openings are worth more than any request costs, and yet finitely much, so that
/// sums are finite.
std::vector<PlacedPacket> withFiniteOpenings(std::vector<PlacedPacket> packets,
                                             uint64_t request_bytes);

}  // namespace tetrakis::inline receiver
