// SPDX-License-Identifier: Apache-2.0
// The functions here translate between names of lengths and metres, because files say "US survey
// foot" and streams "us-ft". The feet are defined by the international yard and pound agreement of
// 1959.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tetrakis::inline base {

/// Metres between samples where nothing says how many: those of the global one-arc-second models.
/// Encoders price height errors, and cameras stand, as if they were this far apart.
inline constexpr double kUnknownSpacing = 30;

/// Our name of a length ("m", "cm", "mm", "km", "ft", "us-ft") for another one of it ("metres",
/// "US survey foot", "ftUS"), in upper or lower case; every other text as it is.
std::string canonicalUnit(std::string_view unit);

/// Metres in one `unit`, by any of its names. An unknown unit ("") is taken for metres; nothing if
/// the unit is no length.
std::optional<double> metresPerUnit(std::string_view unit);

/// Our name of the unit that is so many metres long; "" if it has none.
std::string lengthName(double metres);

}  // namespace tetrakis::inline base
