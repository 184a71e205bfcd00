// SPDX-License-Identifier: Apache-2.0
#include "bitstream/byte_planes.hpp"

#include <algorithm>

namespace tetrakis {

std::vector<uint8_t> toBytePlanes(std::span<const uint32_t> words, int bytes) {
  std::vector<uint8_t> planes;
  planes.reserve(words.size() * static_cast<size_t>(bytes));
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    for (const uint32_t word : words) planes.push_back(static_cast<uint8_t>(word >> shift));
  }
  return planes;
}

std::vector<uint32_t> fromBytePlanes(std::span<const uint8_t> planes, size_t count, int bytes) {
  std::vector<uint32_t> words(std::min(count, planes.size()));
  for (size_t i = 0; i < words.size(); ++i) {
    size_t at = i;
    int shift = 8 * (bytes - 1);
    for (; shift >= 0 && at < planes.size(); shift -= 8, at += count)
      words[i] |= uint32_t{planes[at]} << shift;
    if (shift >= 0) words[i] |= uint32_t{0x80} << shift;
  }
  return words;
}

}  // namespace tetrakis
