// SPDX-License-Identifier: Apache-2.0
// The packets of its stream that a decoder knows ahead of their bytes: all that a front index
// lists, or the packets of the index pages whose records it has (bitstream/stream/page_index.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "bitstream/stream/page_index.hpp"
#include "bitstream/stream/pieces.hpp"
#include "bitstream/stream/scattered_packets.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline api {

/// Whether bytes may come in any order.
inline bool hasIndex(const tks_decoder& decoder) {
  return decoder.index != TKS_INDEX_NONE;
}

/// How many packets are known.
inline uint64_t knownPackets(const tks_decoder& decoder) {
  return decoder.pages ? decoder.pages->knownPackets() : decoder.parsed.header.index.size();
}

/// How many pages of the index are not known.
inline uint64_t lackingPages(const tks_decoder& decoder) {
  return decoder.pages ? decoder.pages->grid().pages() - decoder.pages->knownPages() : 0;
}

/// Calls take(head, begin, payload, end) with the places of each packet that is known, as far as
/// the payload goes, in the order of the stream.
template <class Take>
void forEachKnownPacket(const tks_decoder& decoder, const Take& take) {
  const StreamHeader& header = decoder.parsed.header;
  const uint64_t end = decoder.parsed.bytes + header.payload_bytes;
  const auto within = [&](const auto& packet, const PacketHead& head, uint64_t behind) {
    take(head, packet.begin, std::min(packet.payload, end), std::min(behind, end));
  };
  if (!decoder.pages) {
    for (const IndexedPacket& packet : IndexedPackets(header, decoder.parsed.bytes))
      within(packet, packet.entry.packet, packet.end);
    return;
  }
  for (const PagedPacket& packet : decoder.pages->inOrder(decoder.pages->known()))
    within(packet, packet.head, packet.end());
}

/// Takes the records of index pages that are there now, of those in the ranges, and returns the
/// pages that were not known before. TKS_CORRUPT.
Result<std::vector<uint32_t>> takeRecords(tks_decoder& decoder, std::span<const ByteRange> ranges);

/// The records that have to be there before all packets of these tracks are known, and what lies
/// between those that are near each other. Takes records that are there already. needed: by the
/// numbers of the tracks of heights. TKS_CORRUPT.
Result<std::vector<ByteRange>> lackingRecords(tks_decoder& decoder,
                                              const std::vector<bool>& needed);

}  // namespace tetrakis::inline api
