// SPDX-License-Identifier: Apache-2.0
// Bytes of a stream that came in any order, and what of its packets they hold.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"

namespace tetrakis::inline stream {

/// Bytes of a stream; `end` lies behind the last.
struct ByteRange {
  uint64_t begin = 0, end = 0;
  bool operator==(const ByteRange&) const = default;
};

/// Runs of bytes by their places in the stream. No two of them touch.
class Pieces {
 public:
  /// Takes the bytes that are not there yet; of the others those that came first stay.
  void put(uint64_t place, std::span<const uint8_t> bytes);

  /// What is there from a place on, up to the first byte that is missing. Valid until put().
  std::span<const uint8_t> from(uint64_t place) const;

  /// What is not there of a range, in the order of the bytes.
  std::vector<ByteRange> missing(ByteRange wanted) const;

  uint64_t bytes() const { return bytes_; }
  bool empty() const { return runs_.empty(); }

 private:
  std::map<uint64_t, std::vector<uint8_t>> runs_;
  uint64_t bytes_ = 0;
};

/// What a component's tracks need before any of their coefficients can be told: the first track
/// begins with it.
uint64_t openingBytes(const StreamHeader& header, Component component);

/// Adds to what was taken from the first run of a stream with a front index the packets behind its
/// end. Of each track that is what goes on where its bytes before end: a codeword has no gaps.
/// TKS_CORRUPT where a packet's head is not the one that the index tells.
Status addScattered(const Pieces& pieces, const ParsedHeader& parsed, Demultiplexed& payload);

}  // namespace tetrakis::inline stream
