// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/pictures/tag_number.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace tetrakis::tools {
namespace {

constexpr std::string_view kPadding(" \t\r\n\0", 5);

/// What a text that begins as 1 or -1 goes on with for a number that is none or infinite, as C
/// libraries of Windows wrote it: 1.#INF, -1.#IND, 1.#QNAN, with digits behind or without.
std::optional<double> windowsNumber(double value, std::string_view rest) {
  if (rest.starts_with("#INF")) return std::copysign(HUGE_VAL, value);
  for (const std::string_view none : {"#IND", "#QNAN", "#SNAN"})
    if (rest.starts_with(none)) return std::numeric_limits<double>::quiet_NaN();
  return {};
}

}  // namespace

bool isBlank(std::string_view text) {
  return text.find_first_not_of(kPadding) == std::string_view::npos;
}

std::optional<double> tagNumber(std::string_view text) {
  const size_t start = text.find_first_not_of(" +");
  if (start == std::string_view::npos) return {};
  text.remove_prefix(start);
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc()) return {};
  text.remove_prefix(static_cast<size_t>(end.ptr - text.data()));
  if (isBlank(text)) return value;
  return windowsNumber(value, text);
}

}  // namespace tetrakis::tools
