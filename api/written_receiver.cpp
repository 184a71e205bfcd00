// SPDX-License-Identifier: Apache-2.0
// tks_receiver_write() hands over what came of groups as a sequence: the streams end where their
// first byte is missing, and the heads say so.
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "api/receiver.hpp"

namespace tetrakis::inline api {

namespace {

/// The head of a group for so much of its stream; none: what it goes on from was not written.
std::optional<GroupHead> headFor(const HeldGroup& group, uint64_t stream_bytes,
                                 const std::optional<WrittenGroup>& before) {
  GroupHead head = group.parsed->head;
  head.stream_bytes = stream_bytes;
  head.index_bytes = 0;
  if (head.back.none()) return head;
  if (!before || before->number + 1 != head.number || before->back.depth + 1 != head.back.depth)
    return std::nullopt;
  head.back.bytes = before->back.bytes + before->bytes;
  return head;
}

std::vector<uint8_t> write(tks_receiver& receiver, uint64_t frame) {
  const std::optional<uint64_t> first = firstThatStays(receiver, frame);
  std::optional<WrittenGroup> last = receiver.written;
  std::vector<uint8_t> out;
  for (const auto& [number, group] : receiver.groups) {
    if (first && number >= *first) break;
    if (!decodes(receiver, number)) continue;
    const std::span<const uint8_t> stream = group.stream();
    const std::optional<GroupHead> head = headFor(group, stream.size(), last);
    if (!head) continue;
    const std::vector<uint8_t> bytes = writeHead(*head);
    out.insert(out.end(), bytes.begin(), bytes.end());
    out.insert(out.end(), stream.begin(), stream.end());
    last = WrittenGroup{number, bytes.size() + stream.size(), head->back};
  }
  receiver.written = last;
  return out;
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_receiver_write(tks_receiver* receiver, uint64_t frame, tks_buffer* out) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::keepingSentence(receiver, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    const std::vector<uint8_t> bytes = tetrakis::write(*receiver, frame);
    if (!bytes.empty()) tetrakis::giveBytes(bytes, *out);
    tetrakis::giveUpBefore(*receiver, frame);
    return {};
  });
}
