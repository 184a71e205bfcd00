// SPDX-License-Identifier: Apache-2.0
// Lengths and sizes as people type them: "0.5m", "30,25", "64k".
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/status.hpp"

namespace tetrakis::tools {

/// Our name of a length ("m", "cm", "mm", "km", "ft", "us-ft") for another one of it ("metres",
/// "US survey foot", "ftUS"), in upper or lower case; every other text as it is.
std::string canonicalUnit(const std::string& unit);

/// Metres in one `unit`, by any of its names. An unknown unit ("") is taken for metres; nothing if
/// the unit is no length.
std::optional<double> metresPerUnit(const std::string& unit);

/// Our name of the unit that is so many metres long; "" if it has none.
std::string lengthName(double metres);

/// A non-negative number with an optional suffix m, cm, mm, km, ft or us-ft, converted to `unit`.
/// Without a suffix the number is in `unit` already. TKS_USAGE if `text` is no such length, or if
/// it has a suffix and `unit` is no length.
Result<double> parseLength(const std::string& text, const std::string& unit);

/// A number of bytes: digits, then nothing or k, M or G for powers of 1024, as such or with B or
/// iB, in upper or lower case. TKS_USAGE if `text` is none, or beyond 64 bits.
Result<uint64_t> parseSize(const std::string& text);

/// "S" or "X,Y": two positive numbers, metres per sample along rows and columns.
Result<std::array<double, 2>> parseSpacing(const std::string& text);

}  // namespace tetrakis::tools
