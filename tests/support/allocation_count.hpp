// SPDX-License-Identifier: Apache-2.0
// Counts the bytes that a test executable has allocated, and lets an allocation fail: by operator
// new, and by malloc and calloc in whatever is linked with allocation_count.cpp and wraps malloc,
// calloc and free (tests/api/CMakeLists.txt).
#pragma once

#include <cstdint>

namespace tetrakis::test {

/// Begins to count anew. Not while other threads allocate.
void startCounting();

/// The most bytes that have been allocated at one time since then, beyond those of that moment.
uint64_t countedPeak();

/// How many blocks of memory there are.
int64_t liveBlocks();

/// The allocation of this number from now on fails, counted from 1; 0: none.
void failAllocation(uint64_t number);

/// Whether there was one of the number that failAllocation() was told.
bool allocationHasFailed();

template <class Work>
uint64_t peakBytes(Work&& work) {
  startCounting();
  work();
  return countedPeak();
}

}  // namespace tetrakis::test
