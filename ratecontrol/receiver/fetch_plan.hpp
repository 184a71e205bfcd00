// SPDX-License-Identifier: Apache-2.0
// planFetch() names the byte ranges of a stream with a front index that help a view most (thesis
// 1.2.5: a static source, a dynamic view). The worth of a packet is the slope that the index
// states, times the cost in the picture of an error in its region, over the mean cost in the
// pictures that the encoder thought of. Only that quotient passes from the encoder's cameras to the
// viewer's. The server knows nothing of it: it hands out byte ranges.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/pieces.hpp"
#include "ratecontrol/receiver/piece_choice.hpp"
#include "ratecontrol/receiver/piece_ranges.hpp"
#include "ratecontrol/receiver/sighting.hpp"

namespace tetrakis::inline receiver {

/// What is not there of the bytes from a place on, up to another one, in their order.
using Missing = std::function<std::vector<ByteRange>(uint64_t begin, uint64_t end)>;

/// What is missing of so many bytes that help most, those that help most first. The first sighting
/// is the present picture, of which gains are; the others are what the viewer may look at later.
/// The opening of a component comes before the rest, and, where requests cost nothing, each track
/// in its order. Neighbours are one range, in the place of the one that helps more. Where requests
/// cost something, ranges are few: the plan has the greatest worth beside the costs of its bytes
/// and of its requests, with bytes in ranges that help little or are there, and a packet may come
/// before an earlier one of its track. TKS_CORRUPT where the index names a track that there is not.
/// Where there is no index, the plan is the bytes in their order.
Result<std::vector<FetchRange>> planFetch(const ParsedHeader& parsed,
                                          std::span<const WeightedSighting> sightings,
                                          const Missing& missing, const FetchLimits& limits);

/// The numbers of the packets of an index in the order that helps all of these most. Errors as of
/// planFetch().
Result<std::vector<size_t>> orderFor(const StreamHeader& header,
                                     std::span<const WeightedSighting> sightings);

/// Bytes that a plan takes at most, whatever it is for.
uint64_t planBytes(const StreamHeader& header);

}  // namespace tetrakis::inline receiver
