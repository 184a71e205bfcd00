// SPDX-License-Identifier: Apache-2.0
// Sorting floats by their bits, and a binary heap.
#include "codec/slope_queue.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace tetrakis {
namespace {

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

SlopeQueue::SlopeQueue(std::span<const double> slopes) : sorted_(slopes.size()) {
  for (size_t v = 0; v < slopes.size(); ++v)
    sorted_[v] = uint64_t{orderedBits(roundDown(slopes[v]))} << 32 | v;
  radixSort(sorted_);
}

Candidate SlopeQueue::front() const {
  const uint64_t entry = sorted_[next_];
  return {floatOf(static_cast<uint32_t>(entry >> 32)), static_cast<VertexId>(entry)};
}

Candidate SlopeQueue::pop() {
  if (next_ < sorted_.size() && (heap_.empty() || front() <= heap_.front())) {
    const Candidate least = front();
    ++next_;
    return least;
  }
  std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
  const Candidate least = heap_.back();
  heap_.pop_back();
  return least;
}

void SlopeQueue::push(const Candidate& candidate) {
  heap_.push_back(candidate);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

bool SlopeQueue::isBeforeAll(const Candidate& candidate) const {
  return (next_ == sorted_.size() || candidate <= front()) &&
         (heap_.empty() || candidate <= heap_.front());
}

}  // namespace tetrakis
