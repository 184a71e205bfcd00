// SPDX-License-Identifier: Apache-2.0
// Names of lengths, and how many metres they are. Files say "US survey foot", streams "us-ft". Foot
// definitions: international yard and pound agreement of 1959.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tetrakis::inline base {

/// Our name of a length ("m", "cm", "mm", "km", "ft", "us-ft") for another one of it ("metres",
/// "US survey foot", "ftUS"), in upper or lower case; every other text as it is.
std::string canonicalUnit(std::string_view unit);

/// Metres in one `unit`, by any of its names. An unknown unit ("") is taken for metres; nothing if
/// the unit is no length.
std::optional<double> metresPerUnit(std::string_view unit);

/// Our name of the unit that is so many metres long; "" if it has none.
std::string lengthName(double metres);

}  // namespace tetrakis::inline base
