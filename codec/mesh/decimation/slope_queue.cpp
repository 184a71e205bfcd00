// SPDX-License-Identifier: Apache-2.0
// Buckets by the bits of floats; a sorted run and a binary heap.
#include "codec/mesh/decimation/slope_queue.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace tetrakis::inline decimation {
namespace {

constexpr uint32_t kPowers = 56;

/// Bits that tell buckets of one power of two apart: seven for a million vertices, fewer for fewer,
/// so that chunks fill.
uint32_t detailOf(size_t vertices) {
  return std::clamp(static_cast<uint32_t>(std::bit_width(vertices)) / 2, 6u, 10u) - 3;
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

/// The largest float that is not above the slope, as its bits.
uint32_t bitsBelow(double slope) {
  const auto nearest = static_cast<float>(slope);
  return orderedBits(nearest) - (static_cast<double>(nearest) > slope ? 1 : 0);
}

/// Smallest float that is not below the slope.
float roundUp(double slope) {
  const auto nearest = static_cast<float>(slope);
  return static_cast<double>(nearest) < slope ? floatOf(orderedBits(nearest) + 1) : nearest;
}

}  // namespace

SlopeQueue::SlopeQueue(double greatest, size_t vertices)
    : shift_(23 - detailOf(vertices)), heads_(size_t{kPowers} << detailOf(vertices), kNone) {
  const auto count = static_cast<uint32_t>(heads_.size());
  first_ = std::max(bitsBelow(greatest) >> shift_, count) - count + 1;
}

uint32_t SlopeQueue::bucketOf(double slope) const {
  const auto last = first_ + static_cast<uint32_t>(heads_.size()) - 1;
  return std::clamp(bitsBelow(slope) >> shift_, first_, last) - first_;
}

float SlopeQueue::lowerEnd(uint32_t bucket) const {
  if (bucket == 0) return -std::numeric_limits<float>::infinity();
  return floatOf((first_ + bucket) << shift_);
}

float SlopeQueue::push(const Candidate& candidate) {
  assert(!std::isnan(candidate.slope));
  const uint32_t bucket = bucketOf(candidate.slope);
  if (bucket > current_) {
    pushLater(bucket, candidate.vertex);
    return lowerEnd(bucket);
  }
  if (opening_) {
    sorted_.push_back(candidate);
  } else {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
  return roundUp(candidate.slope);
}

void SlopeQueue::pushLater(uint32_t bucket, VertexId vertex) {
  uint32_t& head = heads_[bucket];
  if (head == kNone || chunks_[head].count == chunks_[head].vertices.size()) head = newChunk(head);
  Chunk& chunk = chunks_[head];
  assert(chunk.count < chunk.vertices.size());
  chunk.vertices[chunk.count++] = vertex;
}

uint32_t SlopeQueue::newChunk(uint32_t next) {
  if (free_ == kNone) {
    chunks_.push_back({next, 0, {}});
    return static_cast<uint32_t>(chunks_.size() - 1);
  }
  const uint32_t chunk = std::exchange(free_, chunks_[free_].next);
  chunks_[chunk].next = next;
  chunks_[chunk].count = 0;
  return chunk;
}

/// How many entries this chunk of a bucket and those after it hold.
size_t SlopeQueue::entriesFrom(uint32_t chunk) const {
  size_t count = 0;
  for (; chunk != kNone; chunk = chunks_[chunk].next) count += chunks_[chunk].count;
  return count;
}

void SlopeQueue::sortOpened() {
  std::sort(sorted_.begin(), sorted_.end());
}

Candidate SlopeQueue::popOpen() {
  assert(!openIsEmpty());
  const bool from_heap =
      next_sorted_ == sorted_.size() || (!heap_.empty() && heap_.front() < sorted_[next_sorted_]);
  if (!from_heap) return sorted_[next_sorted_++];
  std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
  const Candidate least = heap_.back();
  heap_.pop_back();
  return least;
}

bool SlopeQueue::isFirst(const Candidate& candidate) const {
  return bucketOf(candidate.slope) <= current_ &&
         (next_sorted_ == sorted_.size() || candidate <= sorted_[next_sorted_]) &&
         (heap_.empty() || candidate <= heap_.front());
}

}  // namespace tetrakis::inline decimation
