// SPDX-License-Identifier: Apache-2.0
// The functions here read lengths and sizes as people type them: "0.5m", "30,25", "64k".
#pragma once

#include <array>
#include <string>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// A non-negative number with an optional suffix m, cm, mm, km, ft or us-ft, converted to `unit`.
/// Without a suffix the number is in `unit` already. TKS_USAGE if `text` is no such length, or if
/// it has a suffix and `unit` is no length.
Result<double> parseLength(const std::string& text, const std::string& unit);

/// A number of bytes: digits, then nothing or k, M or G for powers of 1024, as such or with B or
/// iB, in upper or lower case. TKS_USAGE if `text` is none, or beyond 64 bits.
Result<uint64_t> parseSize(const std::string& text);

/// Something a second: digits with a point or without, then nothing or k, M or G for powers of
/// 1000, and "/s" or nothing. `of`: what is counted, such as "bit"; it may stand before "/s".
/// TKS_USAGE if `text` is none, or 0.
Result<double> parseRate(const std::string& text, const std::string& of);

/// "S" or "X,Y": two positive numbers, metres per sample along rows and columns.
Result<std::array<double, 2>> parseSpacing(const std::string& text);

}  // namespace tetrakis::tools
