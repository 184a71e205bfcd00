// SPDX-License-Identifier: Apache-2.0
#include "bitstream/sequence/control_message.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "bitstream/sequence/group_head.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline sequence {

namespace {

using Magic = std::array<uint8_t, 3>;
constexpr Magic kControlMagic = {'T', 'K', 'C'}, kAnswerMagic = {'T', 'K', 'A'};
constexpr uint8_t kControlVersion = 1;
constexpr size_t kBegin = 4, kEnd = 4;  ///< magic and version; checksum
constexpr uint32_t kMostSide = 32768;
constexpr uint64_t kMostFrame = kMostFirstFrame + kMostFrames;
constexpr uint64_t kMostPlace = UINT64_MAX >> 2;

/// Neither infinite nor NaN.
bool isFinite(uint32_t bits) {
  constexpr uint32_t kExponent = 0x7f800000;
  return (bits & kExponent) != kExponent;
}

template <class V>
void visitView(V& v, std::optional<ControlView>& view) {
  uint32_t width = view ? view->width : 0;
  v.varint("width", width, 0, kMostSide);
  if (width == 0 || !v.ok()) return;
  if (!view) view.emplace();
  view->width = width;
  v.varint("height", view->height, 1, kMostSide);
  for (uint32_t& bits : view->rows) {
    v.u32("matrix", bits);
    v.require("matrix", isFinite(bits));
  }
}

template <class V>
void visit(V& v, ControlMessage& message) {
  uint32_t low = static_cast<uint32_t>(message.receiver);
  uint32_t high = static_cast<uint32_t>(message.receiver >> 32);
  v.u32("receiver", low);
  v.u32("receiver", high);
  v.varint("answers", message.answers, 0, UINT32_MAX);
  v.u32("lost", message.lost);
  v.varint("kept", message.kept, 0, kMostFrame);
  uint64_t frame = message.frame ? *message.frame + 1 : 0;
  v.varint("frame", frame, 0, kMostFrame + 1);
  v.varint("link", message.link, 1, kMostRate);
  v.varint("triangles", message.triangles, 0, kMostRate);
  visitView(v, message.view);
  if constexpr (!V::kReads) return;
  message.receiver = uint64_t{high} << 32 | low;
  if (frame > 0) message.frame = frame - 1;
  // Of what came before the first answer nothing is lost.
  const uint32_t told = message.answers < 1 ? 0 : std::min(message.answers - 1, kToldAnswers);
  v.require("lost", told == kToldAnswers || message.lost >> told == 0);
}

FieldWriter begun(const Magic& magic) {
  FieldWriter out;
  out.bytes.assign(magic.begin(), magic.end());
  out.bytes.push_back(kControlVersion);
  return out;
}

std::vector<uint8_t> ended(FieldWriter out) {
  out.u32("crc", crc32(out.bytes));
  return std::move(out.bytes);
}

/// "Corrupt NAME: WHY"; readers of fields know streams alone.
Status corrupt(const std::string& name, std::string_view why) {
  constexpr std::string_view kOfStreams = "Corrupt stream: ";
  if (why.starts_with(kOfStreams)) why.remove_prefix(kOfStreams.size());
  return {TKS_CORRUPT, "Corrupt " + name + ": " + std::string(why)};
}

/// The bytes between magic and checksum.
Result<std::span<const uint8_t>> fieldsOf(std::span<const uint8_t> bytes, const Magic& magic,
                                          const std::string& name) {
  if (bytes.size() < kBegin + kEnd || !std::equal(magic.begin(), magic.end(), bytes.begin()))
    return corrupt(name, "these bytes are none.");
  if (bytes[magic.size()] != kControlVersion)
    return Status(TKS_UNSUPPORTED, "The " + name + " has a version that is not known.");
  uint32_t crc = 0;
  FieldReader(bytes.last(kEnd)).u32("crc", crc);
  if (crc != crc32(bytes.first(bytes.size() - kEnd)))
    return corrupt(name, "its checksum does not match.");
  return bytes.subspan(kBegin, bytes.size() - kBegin - kEnd);
}

}  // namespace

std::vector<uint8_t> writeControl(const ControlMessage& message) {
  ControlMessage copy = message;
  FieldWriter out = begun(kControlMagic);
  visit(out, copy);
  return ended(std::move(out));
}

Result<ControlMessage> readControl(std::span<const uint8_t> bytes) {
  const std::string name = "control message";
  if (bytes.size() > kMostControlBytes) return corrupt(name, "it is too long.");
  const auto fields = fieldsOf(bytes, kControlMagic, name);
  if (!fields.ok()) return fields.status();
  FieldReader reader(*fields, kBegin);
  ControlMessage message;
  visit(reader, message);
  if (!reader.ok()) return corrupt(name, reader.status().message());
  const std::vector<uint8_t> shortest = writeControl(message);
  if (!std::equal(shortest.begin(), shortest.end(), bytes.begin(), bytes.end()))
    return corrupt(name, "its fields take more bytes than they need.");
  return message;
}

std::vector<uint8_t> writeAnswer(const Answer& answer) {
  FieldWriter out = begun(kAnswerMagic);
  out.put(answer.number);
  out.put(answer.end_frame);
  for (const AnswerPiece& piece : answer.pieces) {
    out.put(piece.group);
    out.put(piece.place);
    out.put(piece.bytes.size());
    out.bytes.insert(out.bytes.end(), piece.bytes.begin(), piece.bytes.end());
  }
  return ended(std::move(out));
}

Result<Answer> readAnswer(std::span<const uint8_t> bytes) {
  const std::string name = "answer";
  const auto fields = fieldsOf(bytes, kAnswerMagic, name);
  if (!fields.ok()) return fields.status();
  std::span<const uint8_t> left = *fields;
  FieldReader head(left, kBegin);
  Answer answer;
  head.varint("number", answer.number, 0, UINT32_MAX - 1);
  head.varint("end_frame", answer.end_frame, 0, kMostFrame);
  if (!head.ok()) return corrupt(name, head.status().message());
  left = left.subspan(head.position());
  while (!left.empty()) {
    FieldReader reader(left, bytes.size() - kEnd - left.size());
    AnswerPiece piece;
    uint64_t size = 0;
    reader.varint("group", piece.group, 0, UINT32_MAX);
    reader.varint("place", piece.place, 0, kMostPlace);
    reader.varint("size", size, 1, left.size());
    reader.require("size", size <= left.size() - reader.position());
    if (!reader.ok()) return corrupt(name, reader.status().message());
    piece.bytes = left.subspan(reader.position(), static_cast<size_t>(size));
    left = left.subspan(reader.position() + piece.bytes.size());
    answer.pieces.push_back(piece);
  }
  return answer;
}

}  // namespace tetrakis::inline sequence
