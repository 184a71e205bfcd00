// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/sketch.hpp"

#include <algorithm>
#include <optional>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/header_body.hpp"

namespace tetrakis::inline stream {

namespace {

/// Behind magic, version, profile, level and the size of the body, which headerBytes() has read.
FieldReader bodyOf(std::span<const uint8_t> bytes) {
  FieldReader size(bytes.subspan(kFixedBytes));
  size.take();
  const size_t begin = kFixedBytes + size.position();
  return FieldReader(bytes.subspan(begin), begin);
}

/// What the first bytes of a stream tell of its sketch.
struct Beginning {
  std::optional<ShownStream> sketch;  ///< of one that is there
  bool is_known = true;               ///< whether there is one, and where
};

Beginning beginningOf(std::span<const uint8_t> bytes) {
  constexpr uint64_t kChecksumBytes = 4;
  const Result<uint64_t> header = headerBytes(bytes);
  if (!header.ok()) return {};
  if (bytes.size() <= kFixedBytes) return {{}, false};
  FieldReader body = bodyOf(bytes);
  body.take();  // payload_bytes
  const bool has_sketch = body.take() == kSketch;
  const uint64_t size = has_sketch ? body.take() : 0;
  if (body.starved()) return {{}, *header <= bytes.size()};
  const uint64_t begin = body.origin() + body.position();
  if (!body.ok() || size == 0 || begin + kChecksumBytes > *header ||
      size > *header - kChecksumBytes - begin)
    return {};
  return {ShownStream{begin, begin + size}, true};
}

}  // namespace

std::span<const uint8_t> ShownStream::of(std::span<const uint8_t> bytes) const {
  const auto known = static_cast<size_t>(std::min<uint64_t>(end, bytes.size()));
  return bytes.first(known).subspan(static_cast<size_t>(begin));
}

ShownStream shownIn(std::span<const uint8_t> bytes) {
  const Result<uint64_t> header = headerBytes(bytes);
  if (!header.ok() || *header <= bytes.size()) return {};
  const std::optional<ShownStream> sketch = beginningOf(bytes).sketch;
  return sketch && sketch->begin <= bytes.size() ? *sketch : ShownStream{};
}

Result<uint64_t> leastBytes(std::span<const uint8_t> bytes) {
  const Result<uint64_t> header = headerBytes(bytes);
  if (!header.ok()) return header.status();
  const auto [sketch, is_known] = beginningOf(bytes);
  const uint64_t unknown = std::min<uint64_t>(*header, bytes.size() + 1);
  if (!is_known || (sketch && sketch->begin >= bytes.size())) return unknown;
  if (!sketch) return *header;
  const Result<uint64_t> of_sketch = headerBytes(sketch->of(bytes));
  if (!of_sketch.ok()) return of_sketch.status();
  return sketch->begin + *of_sketch;
}

Result<uint64_t> streamBytes(std::span<const uint8_t> bytes) {
  const Result<uint64_t> header = headerBytes(bytes);
  if (!header.ok()) return header.status();
  if (bytes.size() <= kFixedBytes) return Status(TKS_TRUNCATED, "The header is cut short.");
  FieldReader body = bodyOf(bytes);
  uint64_t payload = 0;
  body.varint("payload_bytes", payload, 0, UINT64_MAX >> 1);
  if (!body.ok()) return body.status();
  return *header + payload;
}

}  // namespace tetrakis::inline stream
