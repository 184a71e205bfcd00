// SPDX-License-Identifier: Apache-2.0
#include "base/shown_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>

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

/// The bytes of the first character of a text that is not empty; 0: it begins with none.
size_t utf8Length(std::string_view text) {
  const auto first = static_cast<uint8_t>(text[0]);
  const int trail = trailOf(first);
  if (trail < 0 || static_cast<size_t>(trail) >= text.size()) return 0;
  if (trail > 0 && !mayFollow(first, static_cast<uint8_t>(text[1]))) return 0;
  for (int k = 2; k <= trail; ++k)
    if ((static_cast<uint8_t>(text[static_cast<size_t>(k)]) & 0xC0) != 0x80) return 0;
  return static_cast<size_t>(trail) + 1;
}

}  // namespace

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = utf8Length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

namespace {

/// Code points from the first to the last.
struct CodeRange {
  uint32_t first, last;
};

/// Unicode Standard Annex 9, 2.0 (bidirectional marks), and the general categories Cc, Zl and Zp.
/// U+FFF9 to U+FFFB annotate; U+206A to U+206F are deprecated.
constexpr CodeRange kEscaped[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x061C, 0x061C},
                                  {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x206F},
                                  {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFB}};

bool isEscaped(uint32_t code) {
  return std::any_of(std::begin(kEscaped), std::end(kEscaped), [&](const CodeRange& range) {
    return range.first <= code && code <= range.last;
  });
}

/// The code point of one character of UTF-8.
uint32_t codeOf(std::string_view character) {
  const auto first = static_cast<uint8_t>(character[0]);
  if (character.size() == 1) return first;
  uint32_t code = first & (0x7Fu >> character.size());
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<uint8_t>(c) & 0x3Fu);
  return code;
}

std::string escapeOf(uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  char text[8];
  std::snprintf(text, sizeof text, "\\u%04x", static_cast<unsigned>(code));
  return text;
}

std::string shown(std::string_view text, bool keeps_lines) {
  std::string all;
  while (!text.empty()) {
    const size_t length = utf8Length(text);
    const std::string_view character = text.substr(0, std::max<size_t>(length, 1));
    text.remove_prefix(character.size());
    if (length == 0) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<uint8_t>(character[0]));
      all += escape;
      continue;
    }
    const uint32_t code = codeOf(character);
    const bool lays_out = keeps_lines && (code == '\n' || code == '\t');
    const bool stays = lays_out || !isEscaped(code);
    all += stays ? std::string(character) : escapeOf(code);
  }
  return all;
}

}  // namespace

std::string shownText(std::string_view text) {
  return shown(text, false);
}

std::string shownLines(std::string_view text) {
  return shown(text, true);
}

/// This computes with whole numbers, because the code that formats floating-point ones would be a
/// large part of a small decoder.
std::string describeBytes(uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {" bytes", " KiB", " MiB", " GiB", " TiB"};
  size_t unit = 0;
  for (uint64_t left = bytes; left >= 1024 && unit + 1 < kUnits.size(); left >>= 10) ++unit;
  const uint64_t one = uint64_t{1} << (10 * unit), whole = bytes / one, part = bytes % one;
  if (part == 0 || whole >= 100)
    return std::to_string(whole + (2 * part >= one ? 1 : 0)) + kUnits[unit];
  const uint64_t tenths = 10 * whole + (10 * part + one / 2) / one;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + kUnits[unit];
}

}  // namespace tetrakis::inline base
