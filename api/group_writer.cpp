// SPDX-License-Identifier: Apache-2.0
#include "api/group_writer.hpp"

#include <algorithm>

namespace tetrakis::inline api {

GroupHead GroupWriter::next(std::span<const int64_t> times, bool goes_on) const {
  GroupHead head;
  head.number = index_.groups();
  head.first_frame = index_.frames();
  head.times.assign(times.begin(), times.end());
  head.clock = clock_;
  if (goes_on && index_.groups() > 0) head.back = {back_.depth + 1, back_.bytes + last_bytes_};
  return head;
}

std::vector<uint8_t> GroupWriter::indexOf(const GroupHead& head, uint64_t bytes_before) const {
  if (!has_index_) return {};
  return index_.next(bytes_before, head.frames(), head.times.front());
}

uint64_t GroupWriter::bytesBeside(GroupHead head, uint64_t stream_bytes) const {
  head.stream_bytes = head.index_bytes = stream_bytes;
  const std::vector<uint8_t> index = indexOf(head, stream_bytes);
  head.index_bytes = std::max<uint64_t>(index.size(), 1);
  return writeHead(head).size() + index.size();
}

void GroupWriter::write(GroupHead head, std::span<const uint8_t> stream, std::vector<uint8_t>& to) {
  head.stream_bytes = stream.size();
  // The index says how many bytes come before it, head included, whose length depends on its own.
  std::vector<uint8_t> head_bytes, index;
  for (int round = 0; round < 3; ++round) {
    head.index_bytes = index.size();
    head_bytes = writeHead(head);
    index = indexOf(head, head_bytes.size() + stream.size());
  }
  for (const std::span<const uint8_t> bytes :
       {std::span<const uint8_t>(head_bytes), stream, std::span<const uint8_t>(index)})
    to.insert(to.end(), bytes.begin(), bytes.end());
  add(head, head_bytes.size() + stream.size() + index.size());
}

void GroupWriter::pass(const ParsedHead& group) {
  add(group.head, group.groupEnd());
}

void GroupWriter::add(const GroupHead& head, uint64_t group_bytes) {
  index_.add({1, group_bytes, head.frames(), head.times.front(), head.index_bytes});
  back_ = head.back;
  last_bytes_ = group_bytes;
}

}  // namespace tetrakis::inline api
