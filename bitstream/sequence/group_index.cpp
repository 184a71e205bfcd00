// SPDX-License-Identifier: Apache-2.0
#include "bitstream/sequence/group_index.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "bitstream/sequence/group_head.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline sequence {

namespace {

constexpr std::array<uint8_t, 4> kIndexMark = {'T', 'K', 'I', 0x1a};

/// How many groups each entry of the index of a group stands for.
std::vector<uint64_t> spansOf(uint64_t number) {
  uint64_t left = number + 1;
  std::vector<uint64_t> spans((uint64_t{1} << std::countr_zero(left)) - 1, 1);
  left -= spans.size() + 1;
  while (left > 0) {
    spans.push_back(uint64_t{1} << std::countr_zero(left));
    left -= spans.back();
  }
  return spans;
}

template <class V>
void visitSpan(V& v, GroupSpan& span, int64_t& later) {
  v.varint("span_bytes", span.bytes, 1, UINT64_MAX >> 2);
  v.varint("span_frames", span.frames, span.groups, span.groups * kMostFrames);
  int64_t back = later - span.first_time;
  v.zigzag("time_back", back, INT64_MAX);
  if constexpr (V::kReads) {
    v.require("time_back", back > 0 && back <= later + kMostTime);
    span.first_time = later - back;
  }
  if (span.groups > 1) v.varint("span_index_bytes", span.index_bytes, 0, kMostIndexBytes);
  later = span.first_time;
}

template <class V>
void visitIndex(V& v, ReadIndex& index) {
  v.varint("number", index.number, 0, UINT32_MAX);
  v.varint("first_frame", index.first_frame, 0, kMostFirstFrame);
  v.varint("bytes_before", index.group_bytes, 1, UINT64_MAX >> 2);
  v.varint("frames", index.own.frames, 1, kMostFrames);
  v.zigzag("first_time", index.own.first_time, kMostTime);
  int64_t later = index.own.first_time;
  if (!v.ok()) return;
  const std::vector<uint64_t> spans = spansOf(index.number);
  for (size_t i = 0; i < spans.size() && v.ok(); ++i) {
    if constexpr (V::kReads) index.before.emplace_back();
    index.before[i].groups = spans[i];
    visitSpan(v, index.before[i], later);
  }
}

}  // namespace

std::vector<GroupSpan> GroupIndex::spansBefore(uint64_t number) const {
  std::vector<GroupSpan> spans;
  uint64_t end = number;
  for (const uint64_t count : spansOf(number)) {
    GroupSpan span = groups_[end - count];
    span.groups = count;
    span.index_bytes = groups_[end - 1].index_bytes;
    for (uint64_t i = end - count + 1; i < end; ++i) {
      span.bytes += groups_[i].bytes;
      span.frames += groups_[i].frames;
    }
    end -= count;
    spans.push_back(span);
  }
  return spans;
}

std::vector<uint8_t> GroupIndex::next(uint64_t bytes_before, uint64_t frames,
                                      int64_t first_time) const {
  ReadIndex index{groups(), frames_, bytes_before, {1, 0, frames, first_time}, {}};
  index.before = spansBefore(index.number);
  FieldWriter out;
  visitIndex(out, index);
  out.u32("index_bytes", static_cast<uint32_t>(out.bytes.size() + kIndexEnd));
  out.u32("crc", crc32(out.bytes));
  out.bytes.insert(out.bytes.end(), kIndexMark.begin(), kIndexMark.end());
  return std::move(out.bytes);
}

void GroupIndex::add(const GroupSpan& group) {
  groups_.push_back(group);
  frames_ += group.frames;
}

std::optional<ReadIndex> readIndex(std::span<const uint8_t> tail) {
  if (tail.size() < kIndexEnd) return std::nullopt;
  if (!std::equal(kIndexMark.begin(), kIndexMark.end(), tail.end() - kIndexMark.size()))
    return std::nullopt;
  FieldReader end(tail.subspan(tail.size() - kIndexEnd));
  uint32_t bytes = 0, crc = 0;
  end.u32("index_bytes", bytes);
  end.u32("crc", crc);
  if (bytes < kIndexEnd || bytes > tail.size()) return std::nullopt;
  const std::span<const uint8_t> all = tail.last(bytes);
  if (crc != crc32(all.first(bytes - 8))) return std::nullopt;
  FieldReader body(all.first(bytes - kIndexEnd));
  ReadIndex index;
  visitIndex(body, index);
  if (!body.ok() || body.position() != bytes - kIndexEnd) return std::nullopt;
  index.group_bytes += bytes;
  index.own.groups = 1;
  index.own.bytes = index.group_bytes;
  index.own.index_bytes = bytes;
  return index;
}

}  // namespace tetrakis::inline sequence
