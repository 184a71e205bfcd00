// SPDX-License-Identifier: Apache-2.0
// A CombinedPart is a stream whose components become those of a combined one: its header, its
// packets, and the error that each of them takes off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline combination {

/// How large the samples of a component are, so that errors of heights and of texels can be weighed
/// against each other.
struct ComponentRange {
  double quality_unit = 1;  ///< rmseOf() of a packet over it is the error in units of the range
  double unsent = 0;        ///< squared error while nothing of it is there, likewise: its variance
};

struct CombinedPart {
  std::span<const uint8_t> bytes;  ///< a stream, or a prefix of one; they outlive this
  std::string name;                ///< of its components that have none
  double weight = 1;               ///< of its errors
  ParsedHeader parsed;
  std::vector<FoundPacket> packets;
  std::vector<double> slopes;  ///< of each packet, on the hull of the stream's error
  bool is_whole = false;       ///< all of its bytes are there
  bool ends_cut = false;       ///< the last packet is what is left of a longer one
};

/// Sets packets, slopes and is_whole, of a part whose header is parsed. ranges: of its components,
/// by number. TKS_CORRUPT.
Status takePackets(CombinedPart& part, const std::vector<ComponentRange>& ranges);

/// The payload of a stream, as far as it is there.
std::span<const uint8_t> behindHeader(std::span<const uint8_t> stream, const ParsedHeader& parsed);

/// A packet of a part.
struct PacketOrigin {
  size_t part, packet;
};

/// The packets of all parts, the steepest first, each part's in their order.
std::vector<PacketOrigin> combinedOrder(const std::vector<CombinedPart>& parts);

}  // namespace tetrakis::inline combination
