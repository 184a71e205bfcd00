// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/checksum.hpp"

#include <array>

namespace tetrakis::inline stream {
namespace {

/// What the eight steps of each byte come to.
constexpr std::array<uint32_t, 256> kSteps = [] {
  std::array<uint32_t, 256> steps{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
    steps[byte] = crc;
  }
  return steps;
}();

}  // namespace

uint32_t crc32(std::span<const uint8_t> bytes) {
  uint32_t crc = 0xffffffff;
  for (const uint8_t byte : bytes) crc = (crc >> 8) ^ kSteps[(crc ^ byte) & 0xff];
  return ~crc;
}

}  // namespace tetrakis::inline stream
