// SPDX-License-Identifier: Apache-2.0
#include "base/describe_bytes.hpp"

#include <array>

namespace tetrakis::inline base {

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
