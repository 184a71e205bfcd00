// SPDX-License-Identifier: Apache-2.0
// The functions here write numbers as text for people.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "base/shown_text.hpp"

namespace tetrakis::tools {

/// With so many digits behind the point; the C locale's point always.
inline std::string fixed(double value, int digits) {
  char text[400];  // the longest double has 309 digits before the point
  return {text, static_cast<size_t>(std::snprintf(text, sizeof text, "%.*f", digits, value))};
}

/// The shortest decimal that reads back as this value; NaN without a sign, which would puzzle
/// readers.
template <class T>
std::string shortest(T value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// A text of a file as UTF-8: what is none is taken for ISO 8859-1.
inline std::string asUtf8(std::string text) {
  if (isUtf8(text)) return text;
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<uint8_t>(c);
    if (byte >= 0x80) out += static_cast<char>(0xC0 | byte >> 6);
    out += byte >= 0x80 ? static_cast<char>(0x80 | (byte & 0x3F)) : c;
  }
  return out;
}

/// "1 sample", "2 samples".
inline std::string counted(uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace tetrakis::tools
