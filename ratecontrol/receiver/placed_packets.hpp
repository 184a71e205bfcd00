// SPDX-License-Identifier: Apache-2.0
// placedPackets() takes the index of a stream and what viewers see, and returns all packets that
// are known, each with its place in the stream and the worth of its bytes to the viewers, from the
// TrackCosts of their sightings.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/page_index.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline receiver {

// TrackCosts gives the cost of an error of each track in the picture of a sighting, divided by its
// mean cost in the pictures that the encoder looked at. It counts how many pixels a sample of the
// track's region covers, how far a height error moves it, and which of the region's levels the
// picture shows.

class TrackCosts {
 public:
  TrackCosts(const StreamHeader& header, const Sighting& sighting);

  /// Whether there is such a track.
  bool holds(const PacketHead& packet) const { return packet.track < of(packet).size(); }
  double at(const PacketHead& packet) const { return of(packet)[packet.track]; }

 private:
  const std::vector<double>& of(const PacketHead& packet) const {
    return costs_[static_cast<size_t>(packet.component)];
  }

  std::array<std::vector<double>, kRoles> costs_;
};

// placedPackets() lists the packets of a front index, or of the pages of an index that are known,
// each with its place in the stream and with the worth of one of its bytes to the viewers. Records
// of pages that are not known count as packets: each is worth what the best packet of its page
// would be, for which it has to be there.

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

/// A packet of the index, or a record of it.
struct PlacedPacket {
  size_t number = 0;
  uint64_t begin = 0, end = 0;  ///< bytes of the stream
  PacketWorth worth;
  bool is_correction = false;  ///< in a track of its own
};

/// What helps more comes first; of what helps alike the greater slope.
bool helpsMore(const PacketWorth& a, const PacketWorth& b);

/// All packets in the stream's order; the first of a front index begins at byte `begin`. pages: the
/// index, where it is in pages, else null. TKS_CORRUPT where the index names a track that there is
/// not.
Result<std::vector<PlacedPacket>> placedPackets(const StreamHeader& header, uint64_t begin,
                                                const PageIndex* pages,
                                                std::span<const WeightedSighting> sightings);

/// Packets whose openings are worth more than any request costs, and yet finitely much, so that
/// sums are finite.
std::vector<PlacedPacket> withFiniteOpenings(std::vector<PlacedPacket> packets,
                                             uint64_t request_bytes);

}  // namespace tetrakis::inline receiver
