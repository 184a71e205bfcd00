// SPDX-License-Identifier: Apache-2.0
// SplitStream makes streams that share the bytes of one stream in another way between heights and
// texture: the order of packets is free, so any pair of prefixes of the two tracks is a stream.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Payload bytes of either component.
struct Split {
  uint64_t heights = 0, texture = 0;

  uint64_t total() const { return heights + texture; }
  auto operator<=>(const Split&) const = default;
};

class SplitStream {
 public:
  /// stream: holds both components, each in one track.
  static Result<SplitStream> take(std::span<const uint8_t> stream);

  /// Bytes of the header that say what comes earlier (codec/wavelet/priority_map.hpp).
  uint64_t mapBytes() const;
  /// All there is of either track.
  Split most() const;
  /// What the stream's own order gives either track with the first `payload` bytes, heads left out.
  Split shipped(uint64_t payload) const;
  /// A stream of these prefixes. Lengths beyond those of the tracks count as theirs.
  std::vector<uint8_t> cut(const Split& split) const;

 private:
  StreamHeader header_;
  Demultiplexed payload_;
};

}  // namespace tetrakis::tools
