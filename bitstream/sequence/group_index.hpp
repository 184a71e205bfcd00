// SPDX-License-Identifier: Apache-2.0
// GroupIndex writes the index of each group, and readIndex() reads one. An index leads from the end
// of a file to any group of it in few steps, though a file only grows:
//
// Let 2^z be the largest power of two that divides n + 1. The index of group n lists the 2^z - 1
// groups before it one by one, from the last on; and then, likewise from the last on, stretches of
// groups, each as long as the index of its last group reaches. So it has about log2 n entries, and
// a reader of the last group finds each other one through one more index at most.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::inline sequence {

/// Groups that follow one another.
struct GroupSpan {
  uint64_t groups = 0;  ///< follows from the number of the group that lists it
  uint64_t bytes = 0;   ///< of all of them, heads and indices included
  uint64_t frames = 0;
  int64_t first_time = 0;
  uint64_t index_bytes = 0;  ///< of the last one of them
};

/// The index of a group as it is read from the end of the group.
struct ReadIndex {
  uint64_t number = 0, first_frame = 0;  ///< of the group
  uint64_t group_bytes = 0;              ///< of the group, with its index
  GroupSpan own;                         ///< the group itself
  std::vector<GroupSpan> before;         ///< from the last one on
};

/// Bytes behind which an index is known to end: its length, its checksum and a mark.
inline constexpr size_t kIndexEnd = 12;

/// Of encoders: all groups so far.
class GroupIndex {
 public:
  uint64_t groups() const { return groups_.size(); }
  uint64_t frames() const { return frames_; }
  /// The index of the next group, of which that many bytes come before it.
  std::vector<uint8_t> next(uint64_t bytes_before, uint64_t frames, int64_t first_time) const;
  /// The group has been written, with its index.
  void add(const GroupSpan& group);

 private:
  /// Those that the index of a group lists.
  std::vector<GroupSpan> spansBefore(uint64_t number) const;

  std::vector<GroupSpan> groups_;
  uint64_t frames_ = 0;
};

/// Reads the index at the end of `tail`, which is the end of a group. Nothing: there is none.
std::optional<ReadIndex> readIndex(std::span<const uint8_t> tail);

}  // namespace tetrakis::inline sequence
