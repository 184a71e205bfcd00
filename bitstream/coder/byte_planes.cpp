// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/byte_planes.hpp"

#include <cassert>

namespace tetrakis::inline coder {

std::vector<uint8_t> toBytePlanes(std::span<const uint32_t> words, int bytes) {
  assert(bytes >= 1 && bytes <= 4);
  std::vector<uint8_t> planes;
  planes.reserve(words.size() * static_cast<size_t>(bytes));
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    for (const uint32_t word : words) planes.push_back(static_cast<uint8_t>(word >> shift));
  }
  return planes;
}

uint32_t BytePlanes::operator[](size_t word) const {
  assert(word < count_);
  uint32_t value = 0;
  int shift = 8 * (bytes_ - 1);
  for (size_t at = word; shift >= 0 && at < planes_.size(); shift -= 8, at += count_)
    value |= uint32_t{planes_[at]} << shift;
  return shift < 0 ? value : value | uint32_t{0x80} << shift;
}

}  // namespace tetrakis::inline coder
