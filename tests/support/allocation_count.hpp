// SPDX-License-Identifier: Apache-2.0
// Counts the bytes that a test executable has allocated, and lets an allocation fail: by operator
// new, and by malloc and calloc in whatever is linked with allocation_count.cpp and wraps malloc,
// calloc and free (tests/api/CMakeLists.txt).
#pragma once

#include <cstdint>
#include <span>

namespace tetrakis::test {

/// Begins to count anew. Not while other threads allocate.
void startCounting();

/// The most bytes that have been allocated at one time since then, beyond those of that moment.
uint64_t countedPeak();

/// How many blocks of memory there are.
int64_t liveBlocks();

/// The allocation of this number from now on fails, counted from 1; 0: none.
void failAllocation(uint64_t number);

/// Begins to note from which place in the code each allocation comes: a hash of the calls that lead
/// to it.
void startNotingPlaces();

/// Ends that, and returns the places of all allocations since, until the next start.
std::span<const uint64_t> notedPlaces();

/// Whether there was one of the number that failAllocation() was told.
bool allocationHasFailed();

template <class Work>
uint64_t peakBytes(Work&& work) {
  startCounting();
  work();
  return countedPeak();
}

}  // namespace tetrakis::test
