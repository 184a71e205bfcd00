// SPDX-License-Identifier: Apache-2.0
// Peak memory of one piece of work, measured in a child process of its own.
#pragma once

#include <cstdint>
#include <functional>

#include "bitstream/status.hpp"

namespace tetrakis::bench {

/// Bytes by which the resident memory of a forked child peaks above that of a child that does
/// nothing (getrusage ru_maxrss, Linux with glibc). `work` runs in the child only; its status code
/// comes back, its message does not.
Result<uint64_t> peakMemory(const std::function<Status()>& work);

}  // namespace tetrakis::bench
