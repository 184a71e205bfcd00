// SPDX-License-Identifier: Apache-2.0
// Reference decoder: header and packets (docs/FORMAT.md, sections 2 and 3).
#include "conformance/reference_decoder/stream.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetrakis::reference {
namespace {

/// Reads fields; after the first that is missing or out of range it returns zeros only.
class Reader {
 public:
  explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  Outcome outcome() const { return outcome_; }
  size_t position() const { return position_; }
  bool atEnd() const { return position_ == bytes_.size(); }
  void fail(Outcome outcome) {
    if (outcome_ == Outcome::kDone) outcome_ = outcome;
  }

  uint64_t u8() {
    if (outcome_ == Outcome::kDone && atEnd()) fail(Outcome::kTruncated);
    return outcome_ == Outcome::kDone ? bytes_[position_++] : 0;
  }
  uint64_t littleEndian(int count) {
    uint64_t value = 0;
    for (int i = 0; i < count; ++i) value |= u8() << (8 * i);
    return value;
  }
  double f64() { return std::bit_cast<double>(littleEndian(8)); }

  /// FORMAT 2: "seven bits a byte, low bits first, bit 7 set while more follow, at most 64 bits".
  uint64_t varint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 70; shift += 7) {
      const uint64_t byte = u8();
      if (shift == 63 && byte > 1) fail(Outcome::kCorrupt);
      value |= (byte & 127) << shift;
      if (byte < 128) break;
    }
    return value;
  }
  int64_t zigzag() {
    const uint64_t coded = varint();
    const auto half = static_cast<int64_t>(coded >> 1);
    return coded & 1 ? -half - 1 : half;
  }
  void text() {
    for (uint64_t left = varint(); left > 0 && outcome_ == Outcome::kDone; --left) u8();
  }

  /// A value outside low ... high is corrupt.
  template <class T>
  T within(T value, int64_t low, int64_t high) {
    const bool below = std::is_signed_v<T> && static_cast<int64_t>(value) < low;
    const bool under = !std::is_signed_v<T> && value < static_cast<T>(low);
    const bool above =
        std::is_signed_v<T> ? static_cast<int64_t>(value) > high : value > static_cast<T>(high);
    if (below || under || above) fail(Outcome::kCorrupt);
    return outcome_ == Outcome::kDone ? value : T{0};
  }
  int small(uint64_t value, int64_t low, int64_t high) {
    return static_cast<int>(within(value, low, high));
  }

 private:
  std::span<const uint8_t> bytes_;
  size_t position_ = 0;
  Outcome outcome_ = Outcome::kDone;
};

/// FORMAT 2: CRC-32, "polynomial EDB88320 reflected, initial and final xor FFFFFFFF".
uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xFFFFFFFFu;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

/// FORMAT 2, table Geometry.
GeometryHeader readGeometry(Reader& in) {
  GeometryHeader g;
  g.width = in.small(in.varint(), 2, 1 << 20);
  g.height = in.small(in.varint(), 2, 1 << 20);
  g.sample = in.small(in.u8(), kU8, kF32);
  g.fractionBits = in.small(in.u8(), 0, 8);
  g.planes = in.small(in.u8(), 0, 30);
  in.within(in.u8(), 0, 1);  // exact
  g.base = in.f64();
  g.step = in.f64();
  in.f64();  // max_error
  if (!std::isfinite(g.base) || !std::isfinite(g.step) || !(g.step > 0)) {
    in.fail(Outcome::kCorrupt);
  }
  return g;
}

/// FORMAT 2, table Texture.
TextureHeader readTexture(Reader& in) {
  TextureHeader t;
  t.width = in.small(in.varint(), 1, 1 << 15);
  t.height = in.small(in.varint(), 1, 1 << 15);
  t.channels = in.small(in.u8(), 1, 4);
  t.sample = in.small(in.u8(), kU8, kU16);
  if (t.sample == kI8) in.fail(Outcome::kCorrupt);
  t.planes = in.small(in.u8(), 0, 30);
  for (size_t i = 0; i < static_cast<size_t>(t.channels); ++i) {
    t.centre[i] = in.small(in.varint(), 0, 65535);
    t.priority[i] = static_cast<int>(in.within(in.zigzag(), -128, 128));
  }
  if (t.channels >= 3) {
    t.colourOrder = in.small(in.u8(), 0, 5);
    for (int& h : t.shear) h = static_cast<int>(in.within(in.zigzag(), -32767, 32767));
  }
  return t;
}

/// FORMAT 2, Metadata and Index: they decode nothing, but their syntax counts.
void skipMetadata(Reader& in) {
  for (int i = 0; i < 4; ++i) in.f64();
  for (int i = 0; i < 3; ++i) in.text();
}

void skipIndex(Reader& in) {
  for (uint64_t left = in.within(in.varint(), 1, 1 << 19); left > 0; --left) {
    in.varint();
    in.u8();
  }
}

/// FORMAT 2: "smallest n such that neither component has more than 4^(n + 8) samples".
uint64_t levelOf(const Stream& stream) {
  int64_t samples = 0;
  if (stream.geometry) samples = int64_t{stream.geometry->width} * stream.geometry->height;
  if (stream.texture) {
    samples = std::max(samples, int64_t{stream.texture->width} * stream.texture->height);
  }
  uint64_t level = 0;
  while (samples > int64_t{1} << (2 * (level + 8))) ++level;
  return level;
}

struct Body {
  uint64_t parts = 0, payloadBytes = 0;
};

/// FORMAT 2, Body.
Body readBody(Reader& in, Stream& stream) {
  Body body;
  body.parts = in.within(in.u8(), 1, 15);
  if ((body.parts & 3) == 0) in.fail(Outcome::kCorrupt);
  body.payloadBytes = in.within(in.varint(), 0, INT64_MAX);
  in.within(in.u8(), 0, 1);               // lossless
  in.within(in.varint(), 0, UINT32_MAX);  // triangles
  if (body.parts & 1) stream.geometry = readGeometry(in);
  if (body.parts & 2) stream.texture = readTexture(in);
  if (body.parts & 4) skipMetadata(in);
  if (body.parts & 8) skipIndex(in);
  if (!in.atEnd()) in.fail(Outcome::kCorrupt);
  return body;
}

/// FORMAT 3. What is inside `payload` of each packet goes to the codeword of its track.
Outcome readPackets(std::span<const uint8_t> payload, uint64_t parts, Stream& stream) {
  while (!payload.empty()) {
    Reader in(payload);
    const uint64_t head = in.varint();
    in.u8();  // quality
    if (in.outcome() == Outcome::kTruncated) break;
    const uint64_t length = head >> 2, track = head & 1;
    const bool whole = head & 2;
    const bool announced = parts >> track & 1;
    if (in.outcome() != Outcome::kDone || length == 0 || !announced) return Outcome::kCorrupt;
    payload = payload.subspan(in.position());
    if (whole && length > payload.size()) break;
    const auto part =
        payload.first(static_cast<size_t>(std::min<uint64_t>(length, payload.size())));
    stream.codewords[track].insert(stream.codewords[track].end(), part.begin(), part.end());
    payload = payload.subspan(part.size());
  }
  return Outcome::kDone;
}

}  // namespace

Stream readStream(std::span<const uint8_t> prefix) {
  Stream stream;
  Reader in(prefix);
  for (const uint64_t expected : {0x54, 0x4B, 0x53, 0x1A}) {
    if (in.u8() != expected) in.fail(Outcome::kCorrupt);
  }
  if (in.u8() != 1 || in.u8() != 0) in.fail(Outcome::kUnsupported);
  const uint64_t level = in.u8();
  const uint64_t bodyBytes = in.within(in.varint(), 0, 1 << 20);
  const size_t bodyStart = in.position();
  if (in.outcome() == Outcome::kDone && prefix.size() - bodyStart < bodyBytes + 4) {
    in.fail(Outcome::kTruncated);
  }
  stream.outcome = in.outcome();
  if (stream.outcome != Outcome::kDone) return stream;

  const size_t bodyEnd = bodyStart + static_cast<size_t>(bodyBytes);
  Reader seal(prefix.subspan(bodyEnd, 4));
  Reader bodyReader(prefix.subspan(bodyStart, static_cast<size_t>(bodyBytes)));
  const Body body = readBody(bodyReader, stream);
  if (seal.littleEndian(4) != crc32(prefix.first(bodyEnd)) ||
      bodyReader.outcome() != Outcome::kDone || levelOf(stream) != level) {
    stream.outcome = Outcome::kCorrupt;
    return stream;
  }
  const auto rest = prefix.subspan(bodyEnd + 4);
  const auto payload =
      rest.first(static_cast<size_t>(std::min<uint64_t>(rest.size(), body.payloadBytes)));
  stream.outcome = readPackets(payload, body.parts, stream);
  return stream;
}

}  // namespace tetrakis::reference
