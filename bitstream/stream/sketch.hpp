// SPDX-License-Identifier: Apache-2.0
// A header that takes many bytes, such as that of an object with a fine base, may begin with a
// sketch: a stream of its own that shows the same in a few bytes. Whoever does not have the whole
// header yet decodes the sketch, as far as it is there (docs/FORMAT.md, section 10).
#pragma once

#include <cstdint>
#include <span>

#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

/// A part of the bytes of a stream; the part may end behind those that are there.
struct ShownStream {
  uint64_t begin = 0, end = UINT64_MAX;

  bool isSketch() const { return begin > 0; }
  std::span<const uint8_t> of(std::span<const uint8_t> bytes) const;
  bool operator==(const ShownStream&) const = default;
};

/// What is decoded of a stream that begins with these bytes: all, or, as long as its header is not
/// there, its sketch.
ShownStream shownIn(std::span<const uint8_t> bytes);

/// The fewest bytes of the stream that can be decoded: its header, or up to the end of that of its
/// sketch. If these bytes end before that is known: a smaller number, but greater than
/// bytes.size(). TKS_CORRUPT, TKS_UNSUPPORTED.
Result<uint64_t> leastBytes(std::span<const uint8_t> bytes);

/// What header and payload of the stream take, as its first bytes tell. TKS_TRUNCATED, TKS_CORRUPT,
/// TKS_UNSUPPORTED.
Result<uint64_t> streamBytes(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline stream
