// SPDX-License-Identifier: Apache-2.0
// tks_sequence_thin() writes a sequence for a thinner channel: the streams of its groups are cut,
// and heads and indices say where the groups lie now.
#include <algorithm>
#include <string>

#include "api/encode_arguments.hpp"
#include "api/encoded_stream.hpp"
#include "api/group_writer.hpp"
#include "api/guarded.hpp"
#include "api/sequence.hpp"

namespace tetrakis::inline api {

namespace {

/// How many bytes of a group's stream stay: its header and what the next group goes on from stay in
/// any case.
Result<uint64_t> bytesThatStay(const tks_sequence& sequence, size_t group, uint64_t budget) {
  const std::vector<uint8_t>& stream = sequence.groups[group].stream;
  const Result<uint64_t> header = headerBytes(stream);
  if (!header.ok()) return header;
  uint64_t least = std::min<uint64_t>(*header, stream.size());
  if (group + 1 < sequence.groups.size() && sequence.groups[group + 1].decodes()) {
    const Result<ParsedHeader> next = readHeader(sequence.groups[group + 1].stream);
    if (!next.ok()) return next.status();
    least = std::max(least, std::min<uint64_t>(referenceOf(next->header), stream.size()));
  }
  return std::clamp<uint64_t>(budget, least, stream.size());
}

}  // namespace

Status checkGapless(const tks_sequence& sequence) {
  uint64_t number = 0, frame = 0;
  for (const KeptGroup& group : sequence.groups) {
    const GroupHead& head = group.parsed.head;
    if (head.number != number++ || head.first_frame != frame)
      return misuse("Groups of the sequence were left out or forgotten: it is not written anew.");
    frame = group.endFrame();
  }
  return {};
}

namespace {

Result<std::vector<uint8_t>> thinned(const tks_sequence& sequence, uint64_t frame_bytes) {
  if (Status status = checkGapless(sequence); !status.ok()) return status;
  if (sequence.groups.empty() || !sequence.groups.front().whole())
    return misuse("The sequence has no whole group.");
  GroupWriter writer(sequence.clock, sequence.groups.front().parsed.head.index_bytes > 0);
  std::vector<uint8_t> out;
  for (size_t i = 0; i < sequence.groups.size() && sequence.groups[i].whole(); ++i) {
    const GroupHead& given = sequence.groups[i].parsed.head;
    const std::span<const uint8_t> stream = sequence.groups[i].stream;
    const GroupHead head = writer.next(given.times, !given.back.none());
    const uint64_t beside = writer.bytesBeside(head, stream.size());
    const uint64_t most =
        frame_bytes > UINT64_MAX / given.frames() ? UINT64_MAX : frame_bytes * given.frames();
    const Result<uint64_t> bytes = bytesThatStay(sequence, i, most - std::min(most, beside));
    if (!bytes.ok()) return bytes.status();
    writer.write(head, stream.first(static_cast<size_t>(*bytes)), out);
  }
  return out;
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_sequence_thin(const tks_sequence* sequence, uint64_t frame_bytes, tks_buffer* out,
                             char* message, size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  if (sequence == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    const auto bytes = tetrakis::thinned(*sequence, frame_bytes);
    if (!bytes.ok()) return bytes.status();
    tetrakis::giveBytes(*bytes, *out);
    return {};
  });
}
