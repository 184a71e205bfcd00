// SPDX-License-Identifier: Apache-2.0
// Numbers as text for people.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

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

/// "1 sample", "2 samples".
inline std::string counted(uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace tetrakis::tools
