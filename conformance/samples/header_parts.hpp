// SPDX-License-Identifier: Apache-2.0
// bodyOf() and withBody() take the header of a sound stream apart and put it together again, so
// that tests find fields by their meaning and change them. The layout is from docs/FORMAT.md,
// section 2:
//
//   body       payload_bytes, varint; parts
//   part       kind, length, both varint; as many bytes
//   component  (part 0 of the body) kind, region_log2, domain, of a byte each here; if the domain
//              is new, its kind, width, height; of heights sample, coding, base, step; of a texture
//              channels, sample, coding; if coding is 2, a wavelet; parts
//   wavelet    planes, 3 filters, fraction_bits, sample_bits; if fraction_bits is 0, first_doubled
//              and rounded_bytes, a varint
//   f64        how many bytes follow; those
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "conformance/samples/header_seal.hpp"

namespace tetrakis::test {

/// The number that begins at bytes[at]; `at` moves behind it.
inline uint64_t takeVarint(std::span<const uint8_t> bytes, size_t& at) {
  uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    value |= uint64_t{bytes[at] & 0x7fu} << shift;
    if (bytes[at++] < 128) return value;
  }
}

inline void putVarint(uint64_t value, std::vector<uint8_t>& to) {
  for (; value >= 128; value >>= 7) to.push_back(static_cast<uint8_t>(value | 128));
  to.push_back(static_cast<uint8_t>(value));
}

struct HeaderPart {
  uint64_t kind = 0;
  std::vector<uint8_t> bytes;
};

/// A body, or a component: fields, and parts behind them.
struct HeaderParts {
  std::vector<uint8_t> fields;
  std::vector<uint8_t> wavelet;  ///< of a component by a wavelet
  std::vector<HeaderPart> parts;

  /// The first part of a kind.
  HeaderPart* find(uint64_t kind) {
    for (HeaderPart& part : parts)
      if (part.kind == kind) return &part;
    return nullptr;
  }
  /// Puts a part behind those of its kind and of lower ones.
  void add(uint64_t kind, const std::vector<uint8_t>& bytes) {
    size_t at = 0;
    while (at < parts.size() && parts[at].kind <= kind) ++at;
    parts.insert(parts.begin() + static_cast<ptrdiff_t>(at), {kind, bytes});
  }
  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> out = fields;
    out.insert(out.end(), wavelet.begin(), wavelet.end());
    for (const HeaderPart& part : parts) {
      putVarint(part.kind, out);
      putVarint(part.bytes.size(), out);
      out.insert(out.end(), part.bytes.begin(), part.bytes.end());
    }
    return out;
  }
};

/// fields: how many bytes stand before the parts.
inline HeaderParts partsOf(std::span<const uint8_t> bytes, size_t fields) {
  HeaderParts out;
  out.fields.assign(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(fields));
  for (size_t at = fields; at < bytes.size();) {
    const uint64_t kind = takeVarint(bytes, at);
    const auto size = static_cast<size_t>(takeVarint(bytes, at));
    const auto part = bytes.subspan(at, size);
    out.parts.push_back({kind, {part.begin(), part.end()}});
    at += size;
  }
  return out;
}

inline constexpr size_t kBodyBytes = 7;  ///< where the length of a header's body stands

inline HeaderParts bodyOf(std::span<const uint8_t> stream) {
  size_t at = kBodyBytes;
  const auto size = static_cast<size_t>(takeVarint(stream, at));
  const auto body = stream.subspan(at, size);
  size_t fields = 0;
  takeVarint(body, fields);  // payload_bytes
  return partsOf(body, fields);
}

/// The stream with another body, sealed.
inline std::vector<uint8_t> withBody(std::span<const uint8_t> stream, const HeaderParts& body) {
  size_t at = kBodyBytes;
  const auto size = static_cast<size_t>(takeVarint(stream, at));
  std::vector<uint8_t> out(stream.begin(), stream.begin() + kBodyBytes);
  const std::vector<uint8_t> bytes = body.bytes();
  putVarint(bytes.size(), out);
  out.insert(out.end(), bytes.begin(), bytes.end());
  out.insert(out.end(), stream.begin() + static_cast<ptrdiff_t>(at + size), stream.end());
  sealHeader(out);
  return out;
}

inline constexpr size_t kDomainByte = 2;  ///< where the number of its domain stands in a component
inline constexpr size_t kFractionByte = 4;  ///< where fraction_bits stands in a wavelet

/// Bytes of a component before `coding`.
inline size_t codingByte(std::span<const uint8_t> bytes, bool is_new_domain) {
  size_t at = kDomainByte + 1;
  if (is_new_domain) {
    ++at;
    takeVarint(bytes, at);
    takeVarint(bytes, at);
  }
  return at + (bytes[0] == 0 ? 1 : 2);
}

/// Heights, or a texture. is_new_domain: its domain is not that of a component before it.
inline HeaderParts componentOf(std::span<const uint8_t> bytes, bool is_new_domain = true) {
  size_t at = codingByte(bytes, is_new_domain);
  const bool lifted = bytes[at++] == 2;
  for (int i = 0; bytes[0] == 0 && i < 2; ++i) at += size_t{1} + bytes[at];
  const size_t wavelet = at;
  if (lifted) {
    at += kFractionByte + 2;
    if (bytes[wavelet + kFractionByte] == 0) takeVarint(bytes, ++at);
  }
  HeaderParts out = partsOf(bytes, at);
  out.wavelet.assign(out.fields.begin() + static_cast<ptrdiff_t>(wavelet), out.fields.end());
  out.fields.resize(wavelet);
  return out;
}

inline constexpr uint64_t kComponentKind = 0;  ///< of parts of a body

/// The only component of a stream.
inline HeaderParts componentOfStream(std::span<const uint8_t> stream) {
  return componentOf(bodyOf(stream).find(kComponentKind)->bytes);
}

/// The stream of one component with another one, sealed.
inline std::vector<uint8_t> withComponent(std::span<const uint8_t> stream,
                                          const HeaderParts& component) {
  HeaderParts body = bodyOf(stream);
  body.find(kComponentKind)->bytes = component.bytes();
  return withBody(stream, body);
}

}  // namespace tetrakis::test
