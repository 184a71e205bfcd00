// SPDX-License-Identifier: Apache-2.0
// planFetch() takes the index of a stream, the bytes that are missing and what a viewer sees, and
// returns the byte ranges that the receiver should fetch next, the most helpful first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/pieces.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "ratecontrol/receiver/placed_packets.hpp"

namespace tetrakis::inline receiver {

// choosePieces() chooses the missing pieces of a stream that are worth their bytes and, if requests
// cost something, their requests.

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

// rangesOf() turns chosen pieces into byte ranges to ask for, and joins neighbours.

/// Bytes to fetch, and what one of the first of them takes off the error of the picture beside
/// other ranges; 0: nothing in this view.
struct FetchRange {
  uint64_t begin = 0, end = 0;
  double gain = 0;
};

/// A range, and the best place among the pieces of the plan that are in it.
struct RankedRange {
  FetchRange range;
  uint32_t rank = 0;

  void join(const RankedRange& next) {
    range.end = next.range.end;
    range.gain = std::max(range.gain, next.range.gain);
    rank = std::min(rank, next.rank);
  }
};

/// Ranges that help go on over bytes that do not, where a request costs more than these. The most
/// helpful come first.
std::vector<FetchRange> rangesOf(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                 const Choice& chosen, uint64_t request_bytes);

// planFetch() names the byte ranges of a stream with a front index that help a view most (thesis
// 1.2.5: a static source, a dynamic view). The worth of a packet is the slope that the index
// states, times the cost in the picture of an error in its region, over the mean cost in the
// pictures that the encoder thought of. Only that quotient passes from the encoder's cameras to the
// viewer's. The server knows nothing of it: it hands out byte ranges.

/// What is not there of the bytes from a place on, up to another one, in their order.
using Missing = std::function<std::vector<ByteRange>(uint64_t begin, uint64_t end)>;

/// What is missing of so many bytes that help most, those that help most first. The first sighting
/// is the present picture, of which gains are; the others are what the viewer may look at later.
/// The opening of a component comes before the rest, and, where requests cost nothing, each track
/// in its order. Neighbours are one range, in the place of the one that helps more. Where requests
/// cost something, ranges are few: the plan has the greatest worth beside the costs of its bytes
/// and of its requests, with bytes in ranges that help little or are there, and a packet may come
/// before an earlier one of its track. TKS_CORRUPT where the index names a track that there is not.
/// Where there is no index, the plan is the bytes in their order. pages: of a stream whose index is
/// in pages, else null; records of pages are planned like packets.
Result<std::vector<FetchRange>> planFetch(const ParsedHeader& parsed, const PageIndex* pages,
                                          std::span<const WeightedSighting> sightings,
                                          const Missing& missing, const FetchLimits& limits);

/// The numbers of the packets of an index in the order that helps all of these most. Errors as of
/// planFetch().
Result<std::vector<size_t>> orderFor(const StreamHeader& header,
                                     std::span<const WeightedSighting> sightings);

/// Bytes that a plan takes at most, whatever it is for. packets: that are known, and records.
uint64_t planBytes(const StreamHeader& header, uint64_t packets);

}  // namespace tetrakis::inline receiver
