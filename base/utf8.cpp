// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.hpp"

#include <cstddef>
#include <cstdint>

namespace tetrakis::inline base {

namespace {

/// Bytes behind the first one, or -1 where no character begins like this.
int trailOf(uint8_t first) {
  if (first < 0x80) return 0;
  if (first < 0xC2) return -1;
  if (first < 0xE0) return 1;
  if (first < 0xF0) return 2;
  return first < 0xF5 ? 3 : -1;
}

/// Of the second byte, which tells long forms, surrogates and what lies beyond U+10FFFF.
bool mayFollow(uint8_t first, uint8_t second) {
  const uint8_t least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const uint8_t most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  return second >= least && second <= most;
}

}  // namespace

size_t utf8Length(std::string_view text) {
  const auto first = static_cast<uint8_t>(text[0]);
  const int trail = trailOf(first);
  if (trail < 0 || static_cast<size_t>(trail) >= text.size()) return 0;
  if (trail > 0 && !mayFollow(first, static_cast<uint8_t>(text[1]))) return 0;
  for (int k = 2; k <= trail; ++k)
    if ((static_cast<uint8_t>(text[static_cast<size_t>(k)]) & 0xC0) != 0x80) return 0;
  return static_cast<size_t>(trail) + 1;
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = utf8Length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace tetrakis::inline base
