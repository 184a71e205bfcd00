// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/checksum.hpp"

#include <array>

namespace tetrakis::inline stream {
namespace {

/// What the eight steps of each byte come to. Made for each call, which takes microseconds: kept it
/// would be a kilobyte of every module that a page loads.
std::array<uint32_t, 256> stepsOfBytes() {
  std::array<uint32_t, 256> steps{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
    steps[byte] = crc;
  }
  return steps;
}

}  // namespace

uint32_t crc32(std::span<const uint8_t> bytes) {
  const std::array<uint32_t, 256> steps = stepsOfBytes();
  uint32_t crc = 0xffffffff;
  for (const uint8_t byte : bytes) crc = (crc >> 8) ^ steps[(crc ^ byte) & 0xff];
  return ~crc;
}

}  // namespace tetrakis::inline stream
