// SPDX-License-Identifier: Apache-2.0
// A sequence is a chain of groups (docs/FORMAT.md, section 14):
//
//   group = head stream index
//
// The stream is an ordinary one, whose components have as many frames as the head says. The head
// says when each frame is, and how long the rest of the group is, so that readers pass from group
// to group. The index behind it leads back to all groups before (group_index.hpp). The frames of a
// group may go on from the last one of the group before (codec/frames/frame_reference.hpp), and
// those from the group before that, up to a point of entry.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::inline sequence {

inline constexpr std::array<uint8_t, 4> kGroupMagic = {'T', 'K', 'G', 0x1a};
inline constexpr uint8_t kGroupVersion = 1;
inline constexpr uint32_t kMostHeadBytes = 1u << 16;
inline constexpr uint32_t kMostFrames = 32;  ///< of a group
inline constexpr uint64_t kMostFirstFrame = uint64_t{UINT32_MAX} * kMostFrames;
inline constexpr uint32_t kMostIndexBytes = 1u << 30;
inline constexpr uint64_t kMostDepth = 63;
inline constexpr int64_t kMostTime = int64_t{1} << 61;  ///< in ticks, either way

/// What a tick is, and when tick 0 is.
struct Clock {
  uint64_t numerator = 0, denominator = 0;  ///< a tick lasts so many seconds; 0: nobody knows
  std::string epoch, calendar;

  bool none() const { return numerator == 0; }
  bool operator==(const Clock&) const = default;

  template <class V>
  void visit(V& v) {
    v.varint("tick_numerator", numerator, 1, UINT64_MAX);
    v.varint("tick_denominator", denominator, 1, UINT64_MAX);
    v.unless(std::string(), epoch, [&] { v.text("epoch", epoch); });
    v.unless(std::string(), calendar, [&] { v.text("calendar", calendar); });
  }
};

/// How far back the point of entry lies that a group needs.
struct WayBack {
  uint64_t depth = 0;  ///< in groups; 0: the group is one
  uint64_t bytes = 0;  ///< from its first byte to the head of this group

  bool none() const { return depth == 0; }

  template <class V>
  void visit(V& v) {
    v.varint("depth", depth, 1, kMostDepth);
    v.varint("bytes_back", bytes, 1, UINT64_MAX >> 2);
  }
};

struct GroupHead {
  uint64_t number = 0;       ///< of the group in the sequence
  uint64_t first_frame = 0;  ///< number of its first frame in the sequence
  uint64_t stream_bytes = 0;
  uint64_t index_bytes = 0;    ///< behind the stream; 0: there is no index
  std::vector<int64_t> times;  ///< of each frame, in ticks, rising
  Clock clock;
  WayBack back;
  std::string later_parts;  ///< of kinds that are not known and inform

  uint32_t frames() const { return static_cast<uint32_t>(times.size()); }

  template <class V>
  void visit(V& v);
};

/// What there is of a group.
struct ParsedHead {
  GroupHead head;
  size_t bytes = 0;  ///< of the head: the stream starts here

  uint64_t streamEnd() const { return bytes + head.stream_bytes; }
  uint64_t groupEnd() const { return streamEnd() + head.index_bytes; }
};

std::vector<uint8_t> writeHead(const GroupHead& head);

/// How many bytes the head takes. If `bytes` ends before that is known: a smaller number, but
/// greater than bytes.size(). TKS_CORRUPT, TKS_UNSUPPORTED.
Result<uint64_t> headBytes(std::span<const uint8_t> bytes);

/// TKS_TRUNCATED if `bytes` ends inside the head; TKS_CORRUPT, TKS_UNSUPPORTED.
Result<ParsedHead> readHead(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline sequence
