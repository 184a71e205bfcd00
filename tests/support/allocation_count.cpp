// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocation_count.hpp"

#include <execinfo.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<int64_t> now = 0, peak = 0, blocks = 0;
std::atomic<uint64_t> left = 0;  // allocations until the one that fails; 0: none will

constexpr size_t kMostNoted = 1 << 17;  // encoders make many thousands
std::array<uint64_t, kMostNoted> places;
std::atomic<size_t> noted = kMostNoted;  // so many: nobody takes notes

/// FNV-1a of the calls that lead to an allocation.
void notePlace() {
  if (noted >= kMostNoted) return;
  std::array<void*, 12> calls;  // some are of the standard library
  const int depth = backtrace(calls.data(), static_cast<int>(calls.size()));
  uint64_t hash = 0xcbf29ce484222325;
  for (int i = 0; i < depth; ++i)
    hash = (hash ^ reinterpret_cast<uintptr_t>(calls[static_cast<size_t>(i)])) * 0x100000001b3;
  const size_t number = noted++;
  if (number < kMostNoted) places[number] = hash;
}

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
  notePlace();
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

void startNotingPlaces() {
  void* loads_the_unwinder;
  backtrace(&loads_the_unwinder, 1);
  noted = 0;
}

std::span<const uint64_t> notedPlaces() {
  return std::span(places).first(std::min(noted.exchange(kMostNoted), kMostNoted));
}

bool allocationHasFailed() {
  return left == 0;
}

}  // namespace tetrakis::test
