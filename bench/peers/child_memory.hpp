// SPDX-License-Identifier: Apache-2.0
// Peak memory of one piece of work, measured in a child process of its own.
#pragma once

#include <cstdint>
#include <functional>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Bytes by which the resident memory of a forked child peaks above that of one that does
/// `baseline` (getrusage ru_maxrss, Linux with glibc): nothing, or the same work on next to nothing
/// where the pages of the program itself, which count as well, would weigh. Both run in children
/// only; their status codes come back, their messages do not.
Result<uint64_t> peakMemory(
    const std::function<Status()>& work,
    const std::function<Status()>& baseline = [] { return Status(); });

}  // namespace tetrakis::bench
