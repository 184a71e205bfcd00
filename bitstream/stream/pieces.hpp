// SPDX-License-Identifier: Apache-2.0
// Pieces holds the bytes of a stream that come in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace tetrakis::inline stream {

/// Bytes of a stream; `end` lies behind the last.
struct ByteRange {
  uint64_t begin = 0, end = 0;
  bool operator==(const ByteRange&) const = default;
};

/// Bytes in one piece, which grows at both ends in time for what is added.
class ByteRun {
 public:
  std::span<const uint8_t> bytes() const { return std::span(room_).subspan(first_); }
  size_t size() const { return room_.size() - first_; }
  void append(std::span<const uint8_t> more) {
    room_.insert(room_.end(), more.begin(), more.end());
  }
  void prepend(std::span<const uint8_t> more);
  /// So that nothing is allocated for the next `more` bytes that are appended.
  void makeRoom(size_t more);

 private:
  std::vector<uint8_t> room_;
  size_t first_ = 0;  ///< what lies before it is free
};

/// Runs of bytes by their places in the stream. No two of them touch.
class Pieces {
 public:
  /// Takes the bytes that are not there yet; of the others those that came first stay. In whatever
  /// order n bytes come, all of it takes time in proportion to n log n.
  void put(uint64_t place, std::span<const uint8_t> bytes);

  /// What is there from a place on, up to the first byte that is missing. Valid until put().
  std::span<const uint8_t> from(uint64_t place) const;

  /// What is not there of a range, in the order of the bytes.
  std::vector<ByteRange> missing(ByteRange wanted) const;

  /// Whether a byte of a range is there.
  bool hasAny(ByteRange range) const;

  uint64_t bytes() const { return bytes_; }
  bool empty() const { return runs_.empty(); }

 private:
  using Runs = std::map<uint64_t, ByteRun>;

  void fill(uint64_t place, std::span<const uint8_t> bytes);
  Runs::iterator moved(Runs::iterator run, uint64_t place);

  Runs runs_;
  uint64_t bytes_ = 0;
};

}  // namespace tetrakis::inline stream
