// SPDX-License-Identifier: Apache-2.0
// memoryLimit() tells how much memory the command line may take: as much as the user says, or a
// share of the machine's. So a few bytes that declare a huge plane end in a sentence, and the
// kernel does not kill the process.
#pragma once

#include <cstdint>
#include <string>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Three quarters of the memory that this process can have; the rest is for libraries, code, and
/// whatever else wants memory meanwhile.
uint64_t defaultMemoryLimit();

/// Of this process from now on; 0: the default.
void setMemoryLimit(uint64_t bytes);
uint64_t memoryLimit();

/// TKS_LIMIT if that is less than `bytes`. what: "reading 'a.tif'".
Status checkMemoryFor(const std::string& what, uint64_t bytes);

}  // namespace tetrakis::tools
