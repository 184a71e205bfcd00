// SPDX-License-Identifier: Apache-2.0
// A GroupWriter puts the head and the index of a group around its stream, group behind group: for
// encoders, and for sequences that are written anew.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/sequence/group_head.hpp"
#include "bitstream/sequence/group_index.hpp"

namespace tetrakis::inline api {

class GroupWriter {
 public:
  GroupWriter() = default;
  GroupWriter(Clock clock, bool has_index) : clock_(std::move(clock)), has_index_(has_index) {}

  const Clock& clock() const { return clock_; }

  /// The head of the next group, but for its lengths. goes_on: from the group before, if there is
  /// one.
  GroupHead next(std::span<const int64_t> times, bool goes_on) const;

  /// The most bytes that head and index take beside a stream of at most so many.
  uint64_t bytesBeside(GroupHead head, uint64_t stream_bytes) const;

  /// Adds a group to the bytes. head: of next(), for a stream that goes on if the head says so.
  void write(GroupHead head, std::span<const uint8_t> stream, std::vector<uint8_t>& to);

  /// A group that was written before, which the next one follows.
  void pass(const ParsedHead& group);

 private:
  std::vector<uint8_t> indexOf(const GroupHead& head, uint64_t bytes_before) const;
  void add(const GroupHead& head, uint64_t group_bytes);

  Clock clock_;
  bool has_index_ = true;
  GroupIndex index_;
  WayBack back_;             ///< of the last group
  uint64_t last_bytes_ = 0;  ///< of the last group
};

}  // namespace tetrakis::inline api
