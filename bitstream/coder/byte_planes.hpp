// SPDX-License-Identifier: Apache-2.0
// toBytePlanes() and BytePlanes store samples that no model helps: first the highest byte of all of
// them, then the next byte of all, so that a prefix still holds every sample roughly.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis::inline coder {

/// words: the lower `bytes` bytes of each count. Takes words.size() * bytes.
inline std::vector<uint8_t> toBytePlanes(std::span<const uint32_t> words, int bytes) {
  assert(bytes >= 1 && bytes <= 4);
  std::vector<uint8_t> planes;
  planes.reserve(words.size() * static_cast<size_t>(bytes));
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    for (const uint32_t word : words) planes.push_back(static_cast<uint8_t>(word >> shift));
  }
  return planes;
}

/// Reads any prefix of such planes.
class BytePlanes {
 public:
  /// count: of the words; bytes: of each.
  BytePlanes(std::span<const uint8_t> planes, size_t count, int bytes)
      : planes_(planes), count_(count), bytes_(bytes) {}

  /// Whether a byte of the word is there.
  bool knows(size_t word) const { return word < planes_.size(); }
  /// The word, with 80 00 00 for bytes that are missing.
  uint32_t operator[](size_t word) const;

 private:
  std::span<const uint8_t> planes_;
  size_t count_;
  int bytes_;
};

inline uint32_t BytePlanes::operator[](size_t word) const {
  assert(word < count_);
  uint32_t value = 0;
  int shift = 8 * (bytes_ - 1);
  for (size_t at = word; shift >= 0 && at < planes_.size(); shift -= 8, at += count_)
    value |= uint32_t{planes_[at]} << shift;
  return shift < 0 ? value : value | uint32_t{0x80} << shift;
}

}  // namespace tetrakis::inline coder
