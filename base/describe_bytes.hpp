// SPDX-License-Identifier: Apache-2.0
// Writes amounts of memory as sentences have them.
#pragma once

#include <cstdint>
#include <string>

namespace tetrakis::inline base {

/// Returns an amount with its unit, such as "21.5 GiB".
std::string describeBytes(uint64_t bytes);

}  // namespace tetrakis::inline base
