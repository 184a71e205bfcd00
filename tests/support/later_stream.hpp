// SPDX-License-Identifier: Apache-2.0
// Streams as later versions may make them: between the packets of a stream stand those of
// components that nobody knows yet.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

inline ListedComponent known(Component component) {
  ListedComponent one;
  one.component = component;
  return one;
}

/// A stream, and a stream of more that holds the same.
struct Among {
  Bytes plain, later;
  /// Of each number of bytes of `later`: bytes of `plain` that hold as much.
  std::vector<size_t> as_much;
};

inline ListedComponent unknown(uint8_t kind, const Domain& domain, uint8_t region_log2,
                               const std::string& rest) {
  return {Component::kOther, kind, domain, region_log2, rest};
}

/// Makes a stream of such components, which has an index if the plain one has.
class LaterStream {
 public:
  LaterStream(const Bytes& plain, std::vector<ListedComponent> components) : plain_(plain) {
    ParsedHeader parsed = *readHeader(plain);
    counts_ = trackCounts(parsed.header);
    begin_ = parsed.bytes;
    header_ = std::move(parsed.header);
    header_.components = std::move(components);
    is_indexed_ = !header_.index.empty();
    told_ = std::exchange(header_.index, {});
    header_.payload_crc.reset();
    later_counts_ = trackCounts(header_);
  }

  Among make() {
    const Demultiplexed packets = *demultiplex(Prefix(plain_).subspan(begin_), begin_, counts_);
    size_t at = begin_;
    for (size_t i = 0; i < packets.heads.size(); ++i) {
      const PacketHead& head = packets.heads[i];
      putUnknown(at);
      const size_t payload = at + headBytes(head, counts_).size();
      slope_ = is_indexed_ ? told_[i].slope : 0;
      putKnown(head, Prefix(plain_).subspan(payload, head.length), at, payload);
      at = payload + head.length;
    }
    putUnknown(at);
    header_.payload_bytes = payload_.size();
    Among among{plain_, writeHeader(header_), {}};
    among.as_much.assign(among.later.size(), 0);
    among.as_much.insert(among.as_much.end(), as_much_.begin(), as_much_.end());
    among.as_much.push_back(plain_.size());
    among.later.insert(among.later.end(), payload_.begin(), payload_.end());
    return among;
  }

 private:
  /// Bytes of which a prefix that ends before one of them holds `at` bytes of the plain stream.
  void put(Prefix bytes, size_t at) {
    payload_.insert(payload_.end(), bytes.begin(), bytes.end());
    as_much_.insert(as_much_.end(), bytes.size(), at);
  }
  void putHead(const PacketHead& head, size_t at) {
    put(headBytes(head, later_counts_), at);
    if (is_indexed_) header_.index.push_back({head, slope_});
  }
  void putKnown(PacketHead head, Prefix bytes, size_t at, size_t payload) {
    head.number = 0;
    while (later_counts_.componentOf(head.number) != head.component) ++head.number;
    putHead(head, at);
    payload_.insert(payload_.end(), bytes.begin(), bytes.end());
    for (size_t i = 0; i < bytes.size(); ++i) as_much_.push_back(i == 0 ? at : payload + i);
  }
  /// A packet of each component that is not known, of any track.
  void putUnknown(size_t at) {
    for (uint8_t number = 0; number < header_.components.size(); ++number) {
      if (later_counts_.componentOf(number) != Component::kOther) continue;
      const uint32_t h = samples::hash(static_cast<uint32_t>(at), number, 31);
      PacketHead head{h % 4 + 1,  0,      static_cast<uint8_t>(h >> 8),
                      h % 3 == 0, number, Component::kOther};
      if (header_.components[number].region_log2 > 0) head.track = h;
      slope_ = static_cast<uint8_t>(h >> 24);
      putHead(head, at);
      put(Bytes(head.length, static_cast<uint8_t>(h >> 16)), at);
    }
  }

  const Bytes& plain_;
  StreamHeader header_;
  size_t begin_ = 0;
  TrackCounts counts_, later_counts_;
  bool is_indexed_ = false;
  std::vector<IndexEntry> told_;  ///< by the plain stream
  uint8_t slope_ = 0;             ///< of the packet whose turn it is
  Bytes payload_;
  std::vector<size_t> as_much_;
};

}  // namespace tetrakis::test
