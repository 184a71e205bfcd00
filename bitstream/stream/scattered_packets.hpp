// SPDX-License-Identifier: Apache-2.0
// ScatteredPackets takes the bytes of a stream as they arrive, in any order, and returns the
// beginning of each track. IndexedPackets tells it from the front index where each packet lies.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/pieces.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

// IndexedPackets walks over the packets of a front index and tells where each lies in the stream:
// the index states their lengths, and their places follow.

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

// ScatteredPackets takes apart the packets of a stream with a front index whose bytes come in any
// order, in time that follows the new bytes. It takes each track up to its first gap, because a
// codeword is decoded from its beginning.

/// What a component's tracks need before any of their coefficients can be told: the first track
/// begins with it.
uint64_t openingBytes(const StreamHeader& header, Component component);

class ScatteredPackets {
 public:
  /// taken: what was taken of the stream up to its first gap. The header outlives this.
  ScatteredPackets(const ParsedHeader& parsed, const Demultiplexed& taken);

  /// The bytes that this takes at most for so many packets of an index.
  static uint64_t bytesOf(uint64_t packets) {
    constexpr uint64_t kNodes = 128;  // of two maps, of a track that has but one packet
    return packets * (sizeof(Place) + kNodes);
  }

  /// TKS_CORRUPT where the index tells another head than that of a packet in the range, as far as
  /// that is there, or a track that there is not.
  Status check(const Pieces& pieces, ByteRange range) const;

  /// Adds to the tracks what the range has brought. check() has found nothing.
  void take(const Pieces& pieces, ByteRange range, Demultiplexed& out);

  /// Where a gap is left, the tracks behind the first of a component wait until its opening is
  /// complete: they mean nothing without it. Returns the components of which some were withdrawn.
  std::array<bool, kComponents> settle(bool has_gap, Demultiplexed& out);

 private:
  struct Place {
    uint64_t begin;  ///< of the packet in the stream
    uint32_t next;   ///< the next packet of its track, kNone: it is the last one
  };
  static constexpr uint32_t kNone = UINT32_MAX;
  /// The packet that a track goes on with, and how many bytes of it were taken.
  struct Frontier {
    uint32_t packet;
    uint64_t taken;
  };
  struct Waiting {
    bool any = false;  ///< tracks wait
    std::map<uint32_t, std::vector<uint8_t>> codewords;
    uint64_t bytes = 0;
  };

  const PacketHead& head(uint32_t packet) const { return header_->index[packet].packet; }
  uint32_t packetAt(uint64_t place) const;
  Status checkHead(const Pieces& pieces, uint32_t packet) const;
  void advance(const Pieces& pieces, Frontier& frontier, Demultiplexed& out);
  void add(const PacketHead& head, std::span<const uint8_t> bytes, Demultiplexed& out);
  void exchangeWaiting(size_t component, Demultiplexed& out);

  const StreamHeader* header_;  ///< so that decoders may be moved while they have none of these
  TrackCounts counts_;
  uint64_t begin_, end_;  ///< of the payload
  std::vector<Place> places_;
  std::array<std::map<uint32_t, Frontier>, kRoles> frontiers_;
  std::array<Waiting, kRoles> waiting_;
};

}  // namespace tetrakis::inline stream
