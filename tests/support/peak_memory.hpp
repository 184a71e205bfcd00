// SPDX-License-Identifier: Apache-2.0
// How much memory a test has taken.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace tetrakis::test {

/// The most bytes that this process has had in memory at a time.
inline size_t peakMemory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace tetrakis::test
