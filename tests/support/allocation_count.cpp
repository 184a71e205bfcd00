// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocation_count.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<int64_t> now = 0, peak = 0, blocks = 0;
std::atomic<uint64_t> left = 0;  // allocations until the one that fails; 0: none will

void count(int64_t bytes) {
  const int64_t sum = now += bytes;
  int64_t before = peak;
  while (before < sum && !peak.compare_exchange_weak(before, sum)) {
  }
}

int64_t sizeOf(void* memory) {
  return memory == nullptr ? 0 : static_cast<int64_t>(malloc_usable_size(memory));
}

void* counted(void* memory) {
  count(sizeOf(memory));
  blocks += memory != nullptr;
  return memory;
}

bool fails() {
  uint64_t before = left;
  while (before > 0 && !left.compare_exchange_weak(before, before - 1)) {
  }
  return before == 1;
}

}  // namespace

// What the linker puts in the place of the three functions (--wrap), and what it calls them.
extern "C" {
void* __real_malloc(size_t);
void* __real_calloc(size_t, size_t);
void __real_free(void*);
void* __wrap_malloc(size_t);
void* __wrap_calloc(size_t, size_t);
void __wrap_free(void*);

void* __wrap_malloc(size_t bytes) {
  return fails() ? nullptr : counted(__real_malloc(bytes));
}
void* __wrap_calloc(size_t items, size_t bytes) {
  return fails() ? nullptr : counted(__real_calloc(items, bytes));
}
void __wrap_free(void* memory) {
  count(-sizeOf(memory));
  blocks -= memory != nullptr;
  __real_free(memory);
}
}

void* operator new(size_t bytes) {
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}

namespace tetrakis::test {

void startCounting() {
  now = peak = 0;
}

uint64_t countedPeak() {
  return static_cast<uint64_t>(std::max<int64_t>(peak, 0));
}

int64_t liveBlocks() {
  return blocks;
}

void failAllocation(uint64_t number) {
  left = number;
}

bool allocationHasFailed() {
  return left == 0;
}

}  // namespace tetrakis::test
