// SPDX-License-Identifier: Apache-2.0
// describeBytes() writes an amount of memory with its unit, for sentences about limits.
#pragma once

#include <cstdint>
#include <string>

namespace tetrakis::inline base {

/// Returns an amount with its unit, such as "21.5 GiB".
std::string describeBytes(uint64_t bytes);

}  // namespace tetrakis::inline base
