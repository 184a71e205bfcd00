// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/indexed_packets.hpp"

namespace tetrakis::inline stream {

IndexedPackets::IndexedPackets(const StreamHeader& header, uint64_t begin)
    : header_(header),
      counts_(trackCounts(header)),
      begin_(begin),
      end_(begin + header.payload_bytes) {}

void IndexedPackets::Iterator::place(uint64_t begin) {
  packet_.begin = begin;
  if (*this == std::default_sentinel) return;
  packet_.entry = packets_.header_.index[packet_.number];
  const PacketHead& head = packet_.entry.packet;
  // A packet begins within 2^63 bytes and has fewer than 2^62, so that 64 bits hold its end.
  packet_.payload = begin + headBytes(head, packets_.counts_).size();
  packet_.end = packet_.payload + head.length;
}

}  // namespace tetrakis::inline stream
