// SPDX-License-Identifier: Apache-2.0
// toBytePlanes() and BytePlanes store samples that no model helps: first the highest byte of all of
// them, then the next byte of all, so that a prefix still holds every sample roughly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis::inline coder {

/// words: the lower `bytes` bytes of each count. Takes words.size() * bytes.
std::vector<uint8_t> toBytePlanes(std::span<const uint32_t> words, int bytes);

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

}  // namespace tetrakis::inline coder
