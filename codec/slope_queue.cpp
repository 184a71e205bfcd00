// SPDX-License-Identifier: Apache-2.0
// Sorting floats by their bits; buckets; a binary heap.
#include "codec/slope_queue.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace tetrakis {
namespace {

constexpr uint32_t kBuckets = 1 << 16;
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// Largest float that is not above the slope.
float roundDown(double slope) {
  const float nearest = static_cast<float>(slope);
  if (static_cast<double>(nearest) <= slope) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

// IEEE 754 floats compare like integers once the bits of negative ones are turned over.
constexpr uint32_t kSign = 0x80000000;
uint32_t orderedBits(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}
float floatOf(uint32_t ordered) {
  return std::bit_cast<float>((ordered & kSign) != 0 ? ordered & ~kSign : ~ordered);
}

/// By the upper half, least digit first; stable, so that vertices stay in order.
void radixSort(std::vector<uint64_t>& entries) {
  constexpr int kDigitBits = 11;
  constexpr uint32_t kDigitMask = (1 << kDigitBits) - 1;
  std::vector<uint64_t> other(entries.size());
  for (int shift = 32; shift < 64; shift += kDigitBits) {
    std::array<uint32_t, kDigitMask + 1> begin{};
    for (const uint64_t e : entries) ++begin[e >> shift & kDigitMask];
    uint32_t sum = 0;
    for (uint32_t& b : begin) sum += std::exchange(b, sum);
    for (const uint64_t e : entries) other[begin[e >> shift & kDigitMask]++] = e;
    entries.swap(other);
  }
}

}  // namespace

SlopeQueue::SlopeQueue(std::span<const double> slopes)
    : sorted_(slopes.size()), buckets_(kBuckets, kNone), free_(kNone) {
  for (size_t v = 0; v < slopes.size(); ++v)
    sorted_[v] = uint64_t{orderedBits(roundDown(slopes[v]))} << 32 | v;
  radixSort(sorted_);
}

Candidate SlopeQueue::sortedFront() const {
  const uint64_t entry = sorted_[next_sorted_];
  return {floatOf(static_cast<uint32_t>(entry >> 32)), static_cast<VertexId>(entry)};
}

/// Makes the least entry either the heap's or the sorted one.
void SlopeQueue::fillHeap() {
  const uint32_t last =
      sortedIsEmpty() ? kBuckets - 1 : static_cast<uint32_t>(sorted_[next_sorted_] >> 48);
  while (heap_.empty() && current_ < last) openBucket(++current_);
}

void SlopeQueue::openBucket(uint32_t bucket) {
  uint32_t i = std::exchange(buckets_[bucket], kNone);
  while (i != kNone) {
    heap_.push_back({entries_[i].slope, entries_[i].vertex});
    const uint32_t next = std::exchange(entries_[i].next, free_);
    free_ = std::exchange(i, next);
  }
  std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
}

Candidate SlopeQueue::pop() {
  fillHeap();
  if (!sortedIsEmpty() && (heap_.empty() || sortedFront() <= heap_.front())) {
    const Candidate least = sortedFront();
    ++next_sorted_;
    return least;
  }
  std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
  const Candidate least = heap_.back();
  heap_.pop_back();
  return least;
}

void SlopeQueue::push(const Candidate& candidate) {
  const uint32_t bucket = orderedBits(roundDown(candidate.slope)) >> 16;
  if (bucket <= current_) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    return;
  }
  const Entry entry{candidate.slope, candidate.vertex, buckets_[bucket]};
  if (free_ == kNone) {
    buckets_[bucket] = static_cast<uint32_t>(entries_.size());
    entries_.push_back(entry);
  } else {
    const uint32_t place = std::exchange(free_, entries_[free_].next);
    buckets_[bucket] = place;
    entries_[place] = entry;
  }
}

bool SlopeQueue::isBeforeAll(const Candidate& candidate) {
  fillHeap();
  return (sortedIsEmpty() || candidate <= sortedFront()) &&
         (heap_.empty() || candidate <= heap_.front());
}

}  // namespace tetrakis
