// SPDX-License-Identifier: Apache-2.0
#include "bitstream/sequence/group_head.hpp"

#include <algorithm>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline sequence {

namespace {

enum HeadPart : uint64_t { kClock = 0, kWayBack = 1 };

constexpr size_t kFixedHead = kGroupMagic.size() + 1;
constexpr size_t kChecksum = 4;

/// Each as what the way from the one before differs by from the way before.
template <class V>
void visitTimes(V& v, std::vector<int64_t>& times) {
  v.zigzag("first_time", times[0], kMostTime);
  int64_t way = 0;
  for (size_t t = 1; t < times.size() && v.ok(); ++t) {
    int64_t next = times[t] - times[t - 1];
    int64_t more = next - way;
    v.zigzag("time", more, INT64_MAX);
    if constexpr (V::kReads) {
      // Both are below 2^63: unsigned sums tell whether the next way is.
      const auto sum = static_cast<uint64_t>(way) + static_cast<uint64_t>(more);
      next = static_cast<int64_t>(sum);
      v.require("time", next > 0 && times[t - 1] <= kMostTime - next);
      if (v.ok()) times[t] = times[t - 1] + next;
    }
    way = next;
  }
}

}  // namespace

template <class V>
void GroupHead::visit(V& v) {
  v.varint("number", number, 0, UINT32_MAX);
  v.varint("first_frame", first_frame, 0, kMostFirstFrame);
  uint32_t count = frames();
  v.varint("frames", count, 1, kMostFrames);
  v.varint("stream_bytes", stream_bytes, 1, UINT64_MAX >> 2);
  v.varint("index_bytes", index_bytes, 0, kMostIndexBytes);
  if (!v.ok()) return;
  times.resize(count);
  visitTimes(v, times);
  v.part(kClock, !clock.none(), [&](auto& part) { clock.visit(part); });
  v.part(kWayBack, !back.none(), [&](auto& part) { back.visit(part); });
  v.endParts(later_parts);
}

std::vector<uint8_t> writeHead(const GroupHead& head) {
  GroupHead copy = head;
  FieldWriter body;
  copy.visit(body);
  FieldWriter out;
  out.bytes.assign(kGroupMagic.begin(), kGroupMagic.end());
  out.bytes.push_back(kGroupVersion);
  out.put(body.bytes.size());
  out.bytes.insert(out.bytes.end(), body.bytes.begin(), body.bytes.end());
  out.u32("crc", crc32(out.bytes));
  return std::move(out.bytes);
}

Result<uint64_t> headBytes(std::span<const uint8_t> bytes) {
  const size_t known = std::min(bytes.size(), kGroupMagic.size());
  if (!std::equal(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(known),
                  kGroupMagic.begin()))
    return Status(TKS_CORRUPT, "This is no group of a sequence: it does not begin with TKG 1A.");
  if (bytes.size() <= kFixedHead) return kFixedHead + 1;
  if (bytes[kGroupMagic.size()] != kGroupVersion)
    return Status(TKS_UNSUPPORTED, "The sequence has a version that this decoder does not know.");
  FieldReader size_reader(bytes.subspan(kFixedHead), kFixedHead);
  const uint64_t body_bytes = size_reader.take();
  if (size_reader.starved()) return bytes.size() + 1;
  if (!size_reader.ok()) return size_reader.status();
  if (body_bytes > kMostHeadBytes)
    return Status(TKS_CORRUPT, "Corrupt sequence: the head of a group claims " +
                                   std::to_string(body_bytes) + " bytes.");
  return kFixedHead + size_reader.position() + body_bytes + kChecksum;
}

Result<ParsedHead> readHead(std::span<const uint8_t> bytes) {
  const Result<uint64_t> needed = headBytes(bytes);
  if (!needed.ok()) return needed.status();
  if (bytes.size() < *needed)
    return Status(TKS_TRUNCATED, "The sequence ends inside the head of a group.");
  ParsedHead parsed;
  parsed.bytes = *needed;
  const size_t end = parsed.bytes - kChecksum;
  uint32_t crc = 0;
  FieldReader(bytes.subspan(end, kChecksum)).u32("crc", crc);
  if (crc != crc32(bytes.first(end)))
    return Status(TKS_CORRUPT, "Corrupt sequence: the checksum of a group's head does not match.");
  FieldReader size_reader(bytes.subspan(kFixedHead), kFixedHead);
  size_reader.take();
  const size_t start = kFixedHead + size_reader.position();
  FieldReader body(bytes.subspan(start, end - start), start);
  parsed.head.visit(body);
  if (!body.ok()) return body.status();
  return parsed;
}

}  // namespace tetrakis::inline sequence
