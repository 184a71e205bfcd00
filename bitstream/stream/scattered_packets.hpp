// SPDX-License-Identifier: Apache-2.0
// ScatteredPackets takes the bytes of a stream as they arrive, in any order, and returns the
// beginning of each track. IndexedPackets tells it from the front index where each packet lies, or
// a PageIndex (page_index.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/page_index.hpp"
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

// ScatteredPackets takes apart the packets of a stream whose bytes come in any order, in time that
// follows the new bytes. It takes each track up to its first gap, because a codeword is decoded
// from its beginning. A front index tells it at once where the packets lie, index pages page by
// page.

// What a component's tracks need before any of their coefficients can be told: the first track
/// begins with it.
uint64_t openingBytes(const StreamHeader& header, Component component);

class ScatteredPackets {
 public:
  /// taken: what was taken of the stream up to its first gap. Knows the packets of a front index.
  /// The header outlives this.
  ScatteredPackets(const ParsedHeader& parsed, const Demultiplexed& taken);

  /// The bytes that this takes at most for so many packets that it knows.
  static uint64_t bytesOf(uint64_t packets) {
    constexpr uint64_t kNodes = 128;  // of two maps, of a track that has but one packet
    return packets * (2 * sizeof(Place) + kNodes);
  }

  /// TKS_CORRUPT where an index tells another head than that of a packet in the range, as far as
  /// that is there, or a track that there is not.
  Status check(const Pieces& pieces, ByteRange range) const;
  /// The same of packets of pages that are not known yet.
  Status check(const Pieces& pieces, std::span<const PagedPacket> pages) const;

  /// Knows the packets of pages as well, which come in the order of the stream, and adds to the
  /// tracks what is there of them. check() has found nothing.
  void take(const Pieces& pieces, std::span<const PagedPacket> pages, Demultiplexed& out);

  /// Adds to the tracks what the range has brought. check() has found nothing.
  void take(const Pieces& pieces, ByteRange range, Demultiplexed& out);

  /// The same of what lies before the first gap, of tracks whose pages are not known. out: has the
  /// heads of all that.
  void takeFront(const Pieces& pieces, const PageIndex& pages, Demultiplexed& out);

  /// Where a gap is left, the tracks behind the first of a component wait until its opening is
  /// complete: they mean nothing without it. Returns the components of which some were withdrawn.
  std::array<bool, kComponents> settle(bool has_gap, Demultiplexed& out);

 private:
  static constexpr uint64_t kNone = UINT64_MAX;
  struct Place {
    uint64_t begin;         ///< of the packet in the stream
    PacketHead head;        ///< pages do not state its quality
    uint64_t next = kNone;  ///< where the next packet of its track begins
  };
  /// The packet that a track goes on with, and how many bytes of it were taken.
  struct Frontier {
    uint64_t packet;  ///< where it begins
    uint64_t taken;
  };
  struct Waiting {
    bool any = false;  ///< tracks wait
    std::map<uint32_t, std::vector<uint8_t>> codewords;
    uint64_t bytes = 0;
  };

  /// Adds packets behind the others, in the order of the stream. All of a track come at once.
  void know(std::vector<Place>&& packets);
  /// The number of the packet that a byte behind the header belongs to.
  size_t packetAt(uint64_t place) const;
  Status checkHead(const Pieces& pieces, const Place& packet) const;
  void advance(const Pieces& pieces, Frontier& frontier, Demultiplexed& out);
  void add(const PacketHead& head, std::span<const uint8_t> bytes, Demultiplexed& out);
  void exchangeWaiting(size_t component, Demultiplexed& out);

  const StreamHeader* header_;  ///< so that decoders may be moved while they have none of these
  TrackCounts counts_;
  uint64_t begin_, end_;  ///< of the payload
  /// Packets before this one were taken whole before their pages were known, and of this one so
  /// many bytes.
  uint64_t front_, front_taken_;
  size_t front_number_;        ///< of it, among the packets from the beginning
  std::vector<Place> places_;  ///< of the packets that are known, as they lie in the stream
  std::array<std::map<uint32_t, Frontier>, kRoles> frontiers_;
  std::array<Waiting, kRoles> waiting_;
};

}  // namespace tetrakis::inline stream
