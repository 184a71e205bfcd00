// SPDX-License-Identifier: Apache-2.0
// Reference decoder: sequences (docs/FORMAT.md, section 14).
#include <algorithm>
#include <optional>
#include <utility>

#include "conformance/reference_decoder/frames.hpp"
#include "conformance/reference_decoder/parts.hpp"
#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {
namespace {

struct Clock {
  uint64_t numerator = 0, denominator = 0;
  std::vector<uint8_t> epoch, calendar;

  bool operator==(const Clock&) const = default;
};

struct GroupHead {
  uint64_t number = 0, firstFrame = 0, streamBytes = 0, indexBytes = 0;
  std::vector<int64_t> times;
  Clock clock;
  uint64_t depth = 0, bytesBack = 0;
  uint64_t bytes = 0;  ///< of the head

  uint64_t groupBytes() const { return bytes + streamBytes + indexBytes; }
};

constexpr int64_t kMostTime = int64_t{1} << 61;

/// "time: its way less the way before, which is 0 at first".
void readTimes(Reader& in, uint64_t frames, GroupHead& head) {
  head.times.push_back(in.longZigzag(kMostTime));
  int64_t way = 0;
  for (uint64_t t = 1; t < frames && in.outcome() == Outcome::kDone; ++t) {
    const int64_t more = in.longZigzag(INT64_MAX);
    way = static_cast<int64_t>(static_cast<uint64_t>(way) + static_cast<uint64_t>(more));
    if (way < 1 || head.times.back() > kMostTime - way) return in.fail(Outcome::kCorrupt);
    head.times.push_back(head.times.back() + way);
  }
}

std::vector<uint8_t> readText(Reader& in) {
  if (in.ends()) return {};
  const auto bytes = in.take(in.varint(0, UINT64_MAX));
  return {bytes.begin(), bytes.end()};
}

void readClock(Reader& in, Clock& clock) {
  clock.numerator = in.varint(1, UINT64_MAX);
  clock.denominator = in.varint(1, UINT64_MAX);
  clock.epoch = readText(in);
  clock.calendar = readText(in);
}

/// Rows 1 to 8 of "Statuses" are its outcome.
Outcome readHead(std::span<const uint8_t> bytes, GroupHead& head) {
  Reader in(bytes);
  for (const int expected : {0x54, 0x4B, 0x47, 0x1A}) in.u8(expected, expected);
  const uint8_t version = in.byte();
  if (in.rest().empty()) in.fail(Outcome::kTruncated);
  if (version != 1) in.fail(Outcome::kUnsupported);
  const auto fields = in.take(in.varint(0, 1 << 16));
  const auto sealed = bytes.first(bytes.size() - in.rest().size());
  const uint64_t crc = in.littleEndian(4);
  if (in.outcome() != Outcome::kDone) return in.outcome();
  if (crc != crc32(sealed)) return Outcome::kCorrupt;
  head.bytes = sealed.size() + 4;
  Reader body(fields);
  head.number = body.varint(0, UINT32_MAX);
  head.firstFrame = body.varint(0, uint64_t{UINT32_MAX} * 32);
  const uint64_t frames = body.varint(1, 32);
  head.streamBytes = body.varint(1, UINT64_MAX >> 2);
  head.indexBytes = body.varint(0, 1 << 30);
  readTimes(body, frames, head);
  Parts parts(body);
  parts.take(0, [&](Reader& p) { readClock(p, head.clock); });
  parts.take(1, [&](Reader& p) {
    head.depth = p.varint(1, 63);
    head.bytesBack = p.varint(1, UINT64_MAX >> 2);
  });
  parts.end();
  return body.outcome() == Outcome::kTruncated ? Outcome::kCorrupt : body.outcome();
}

bool follows(const GroupHead& next, const GroupHead& before) {
  const bool rises = next.number > before.number &&
                     next.firstFrame >= before.firstFrame + before.times.size() &&
                     next.times.front() > before.times.back() && next.clock == before.clock;
  if (next.depth == 0 || next.number > before.number + 1) return rises;
  return rises && next.depth == before.depth + 1 &&
         next.bytesBack == before.bytesBack + before.groupBytes();
}

struct Group {
  GroupHead head;
  std::span<const uint8_t> stream;  ///< what there is of it
};

bool fits(const GeometryHeader& a, const GeometryHeader& b) {
  return a.width == b.width && a.height == b.height && a.sample == b.sample && a.base == b.base &&
         a.step == b.step && b.frames.count > 0 && b.frames.scales.empty();
}

bool fits(const TextureHeader& a, const TextureHeader& b) {
  return a.width == b.width && a.height == b.height && a.sample == b.sample &&
         a.channels == b.channels && a.opaque == b.opaque && a.white == b.white &&
         a.centre == b.centre && a.colourOrder == b.colourOrder && a.shears == b.shears &&
         a.furtherShears == b.furtherShears && b.frames.count > 0;
}

/// Groups, each of which may go on from the one before.
class Chain {
 public:
  Chain(const std::vector<Group>& groups, uint64_t maxSamples)
      : groups_(groups), maxSamples_(maxSamples) {}

  /// The stream of a group with what its frames go on from, or why there is none.
  Stream streamOf(size_t place) const {
    const GroupHead& head = groups_[place].head;
    Stream stream;
    stream.outcome = Outcome::kTruncated;
    if (head.depth > place || groups_[place - head.depth].head.number != head.number - head.depth)
      return stream;
    for (size_t p = place - head.depth; p < place; ++p) {
      const Stream next = readStream(groups_[p + 1].stream, maxSamples_);
      const uint64_t bytes = referenceOf(next);
      const std::span<const uint8_t> all = groups_[p].stream;
      if (bytes == 0 && next.outcome != Outcome::kDone) return next;
      if (bytes == 0 || bytes > all.size()) return corrupt();
      stream = goingOn(readStream(all.first(bytes), maxSamples_), std::move(stream));
      if (stream.outcome != Outcome::kDone) return stream;
    }
    Stream own = readStream(groups_[place].stream, maxSamples_);
    if (own.outcome != Outcome::kDone) return own;
    const uint64_t frames = uint64_t(framesOf(own));
    if (frames != head.times.size() || (referenceOf(own) > 0) != (head.depth > 0)) return corrupt();
    return goingOn(std::move(own), std::move(stream));
  }

 private:
  static Stream corrupt() {
    Stream stream;
    stream.outcome = Outcome::kCorrupt;
    return stream;
  }
  static uint64_t referenceOf(const Stream& stream) {
    const uint64_t heights = stream.geometry ? stream.geometry->frames.reference : 0;
    return std::max(heights, stream.texture ? stream.texture->frames.reference : 0);
  }
  static int framesOf(const Stream& stream) {
    if (stream.geometry) return stream.geometry->frames.shown();
    return stream.texture ? stream.texture->frames.shown() : 1;
  }
  /// before: the stream that it goes on from, if it does.
  static Stream goingOn(Stream stream, Stream before) {
    if (stream.outcome != Outcome::kDone) return stream;
    if (stream.geometry && stream.geometry->frames.reference > 0) {
      if (!before.geometry || !fits(*stream.geometry, *before.geometry)) return corrupt();
      stream.geometry->frames.before =
          lastHeights(*before.geometry, before.layers, before.codewords[0]);
    }
    if (stream.texture && stream.texture->frames.reference > 0) {
      if (!before.texture || !fits(*stream.texture, *before.texture)) return corrupt();
      stream.texture->frames.before = lastTexels(*before.texture, before.codewords[1]);
    }
    return stream;
  }

  const std::vector<Group>& groups_;
  uint64_t maxSamples_;
};

}  // namespace

DecodedSequence decodeSequence(std::span<const uint8_t> prefix, uint64_t maxSamples,
                               Levels levels) {
  DecodedSequence decoded;
  std::vector<Group> groups;
  while (!prefix.empty()) {
    GroupHead head;
    Outcome outcome = readHead(prefix, head);
    if (outcome == Outcome::kTruncated) break;
    if (outcome == Outcome::kDone && !groups.empty() && !follows(head, groups.back().head))
      outcome = Outcome::kCorrupt;
    decoded.outcome = outcome;
    if (outcome != Outcome::kDone) break;
    const auto behind = prefix.subspan(head.bytes);
    groups.push_back({head, behind.first(std::min<uint64_t>(head.streamBytes, behind.size()))});
    prefix = prefix.subspan(std::min<uint64_t>(head.groupBytes(), prefix.size()));
  }
  const Chain chain(groups, maxSamples);
  for (size_t place = 0; place < groups.size(); ++place) {
    const Group& group = groups[place];
    const Decoded frames = decode(chain.streamOf(place), levels);
    const bool begun = group.stream.size() < group.head.streamBytes;
    if (begun && readStream(group.stream, maxSamples).outcome == Outcome::kTruncated) break;
    decoded.groups.push_back({group.head.firstFrame, group.head.times, frames});
  }
  return decoded;
}

}  // namespace tetrakis::reference
