// SPDX-License-Identifier: Apache-2.0
// choosePieces() chooses the missing pieces of a stream that are worth their bytes and, if requests
// cost something, their requests.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ratecontrol/receiver/placed_packets.hpp"

namespace tetrakis::inline receiver {

/// What a plan may take.
struct FetchLimits {
  uint64_t bytes = 0;          ///< of all ranges
  uint64_t request_bytes = 0;  ///< that come in the time that a request costs beside its own
};

/// A part of a packet that is missing, or bytes between two of them that are there.
struct Piece {
  uint64_t begin = 0, end = 0;
  PacketWorth worth;
  bool is_missing = true;

  uint64_t size() const { return end - begin; }
  bool helps() const { return worth.now > 0; }
};

/// Numbers of the missing pieces, those first that help most.
std::vector<uint32_t> rankedPieces(std::span<const Piece> pieces);

/// Bytes of each piece, from its begin on.
using Choice = std::vector<uint64_t>;

/// order: of rankedPieces().
Choice choosePieces(std::span<const Piece> pieces, std::span<const uint32_t> order,
                    const FetchLimits& limits);

}  // namespace tetrakis::inline receiver
