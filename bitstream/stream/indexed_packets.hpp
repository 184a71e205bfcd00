// SPDX-License-Identifier: Apache-2.0
// IndexedPackets walks over the packets of a front index and tells where each lies in the stream:
// the index states their lengths, and their places follow.
#pragma once

#include <cstdint>

#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// A packet of the index and its bytes in the stream. The last packet may end beyond the payload,
/// which an encoder cut to a budget.
struct IndexedPacket {
  size_t number = 0;     ///< in the index
  IndexEntry entry;      ///< may name a track that there is not
  uint64_t begin = 0;    ///< of its head
  uint64_t payload = 0;  ///< behind its head
  uint64_t end = 0;
};

/// The packets of the index in the stream's order, up to the first one that begins where the
/// payload ends: behind a payload that was cut to a budget the index runs ahead of the packets.
class IndexedPackets {
 public:
  class Iterator {
   public:
    Iterator(const IndexedPackets& packets, uint64_t begin) : packets_(packets) { place(begin); }

    const IndexedPacket& operator*() const { return packet_; }
    Iterator& operator++() {
      ++packet_.number;
      place(packet_.end);
      return *this;
    }
    bool operator==(std::default_sentinel_t) const {
      return packet_.number == packets_.header_.index.size() || packet_.begin >= packets_.end_;
    }

   private:
    /// Takes the packet of this number, which begins there, from the index.
    void place(uint64_t begin);

    const IndexedPackets& packets_;
    IndexedPacket packet_;
  };

  /// header: outlives this. begin: the byte of the stream behind its header.
  IndexedPackets(const StreamHeader& header, uint64_t begin);

  Iterator begin() const { return {*this, begin_}; }
  std::default_sentinel_t end() const { return {}; }

 private:
  const StreamHeader& header_;
  TrackCounts counts_;
  uint64_t begin_ = 0, end_ = 0;  ///< of the payload
};

}  // namespace tetrakis::inline stream
