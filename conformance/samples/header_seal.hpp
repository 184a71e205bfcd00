// SPDX-License-Identifier: Apache-2.0
// sealHeader() makes a damaged header pass its checksum, so that tests reach the checks behind the
// checksum. The layout is from docs/FORMAT.md, section 2:
//
//   byte 0   magic, 4 bytes
//   byte 4   version, profile, level
//   byte 7   varint  size of the body (LEB128: 7 bits a byte, low bits first)
//            body
//            CRC-32 (IEEE 802.3, little endian) of everything before it
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tetrakis::test {

inline uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xffffffffu;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// Writes the right checksum behind the body; leaves streams alone that end before it.
inline void sealHeader(std::span<uint8_t> stream) {
  uint64_t body = 0;
  size_t at = 7;
  for (int shift = 0; at < stream.size() && shift < 28; shift += 7) {
    body |= uint64_t{stream[at] & 0x7fu} << shift;
    if (stream[at++] < 0x80) break;
  }
  if (at + body + 4 > stream.size()) return;
  const size_t end = at + static_cast<size_t>(body);
  const uint32_t crc = crc32(stream.first(end));
  for (size_t i = 0; i < 4; ++i) stream[end + i] = static_cast<uint8_t>(crc >> (8 * i));
}

}  // namespace tetrakis::test
