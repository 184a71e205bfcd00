// SPDX-License-Identifier: Apache-2.0
// TrackCosts gives the cost of an error of each track in the picture of a sighting, divided by its
// mean cost in the pictures that the encoder looked at. It counts how many pixels a sample of the
// track's region covers, how far a height error moves it, and which of the region's levels the
// picture shows.
#pragma once

#include <array>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "ratecontrol/receiver/sighting.hpp"

namespace tetrakis::inline receiver {

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

}  // namespace tetrakis::inline receiver
