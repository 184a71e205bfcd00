// SPDX-License-Identifier: Apache-2.0
// Amounts of memory in sentences.
#pragma once

#include <cstdint>
#include <string>

namespace tetrakis {

/// "21.5 GiB".
std::string describeBytes(uint64_t bytes);

}  // namespace tetrakis
