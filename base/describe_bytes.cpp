// SPDX-License-Identifier: Apache-2.0
#include "base/describe_bytes.hpp"

#include <array>
#include <cstdio>

namespace tetrakis::inline base {

std::string describeBytes(uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  auto value = static_cast<double>(bytes);
  size_t unit = 0;
  for (; value >= 1024 && unit + 1 < kUnits.size(); ++unit) value /= 1024;
  std::array<char, 32> text;
  const bool tenths = unit > 0 && value < 100 && value != static_cast<double>(int64_t(value));
  std::snprintf(text.data(), text.size(), tenths ? "%.1f %s" : "%.0f %s", value, kUnits[unit]);
  return text.data();
}

}  // namespace tetrakis::inline base
