// SPDX-License-Identifier: Apache-2.0
#include "base/shown_text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>

#include "base/utf8.hpp"

namespace tetrakis::inline base {

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

}  // namespace tetrakis::inline base
