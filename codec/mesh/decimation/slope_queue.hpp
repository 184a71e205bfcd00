// SPDX-License-Identifier: Apache-2.0
// SlopeQueue is a lazy queue that hands out vertices by rising slope. An entry holds a lower bound
// of the present slope of its vertex.
//
// Slopes at the front hardly ever fall, so most entries are not sorted before they come near it:
//   later   vertices alone, by the upper bits of their slope as a float: 128 buckets (fewer where
//           there are few vertices) for each of the greatest 56 powers of two, each a list of
//           chunks of one cache line;
//   open    the candidates of the buckets up to the current one: those that were there when it was
//           opened, sorted, and a heap of those that came since.
// A bucket is opened by handing its vertices back to the caller, who pushes those that still remain
// with their present slopes. So most entries that are out of date are never compared.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline decimation {

/// A vertex and a slope. Candidates are ordered by slope; among equal slopes the coarser vertex
/// comes first, because its merging domain holds the finer ones.
struct Candidate {
  double slope = 0;
  VertexId vertex = 0;
  auto operator<=>(const Candidate&) const = default;
};

class SlopeQueue {
 public:
  /// greatest: an upper bound of all finite slopes; 0 if none is positive. vertices: about how many
  /// vertices the queue will hold.
  SlopeQueue(double greatest, size_t vertices);

  /// Adds an entry; its slope must not be NaN. Returns a bound: when the slope of the vertex falls
  /// below it, the vertex must be pushed again.
  float push(const Candidate& candidate);
  /// Removes and returns the least entry; the queue must not be empty. When a bucket is opened,
  /// pushAgain(std::span<const VertexId>) is called with its vertices, some at a time, and may push
  /// them.
  template <class PushAgain>
  Candidate pop(PushAgain&& pushAgain);
  /// Whether a candidate that was just popped, and whose slope may have risen since, comes before
  /// every entry.
  bool isFirst(const Candidate& candidate) const;

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  struct Chunk {
    uint32_t next;
    uint32_t count;
    std::array<VertexId, 14> vertices;
  };

  bool openIsEmpty() const { return next_sorted_ == sorted_.size() && heap_.empty(); }
  void pushLater(uint32_t bucket, VertexId vertex);
  uint32_t newChunk(uint32_t next);
  size_t entriesFrom(uint32_t chunk) const;
  template <class PushAgain>
  void openNextBucket(PushAgain& pushAgain);
  void sortOpened();
  Candidate popOpen();

  uint32_t bucketOf(double slope) const;
  float lowerEnd(uint32_t bucket) const;

  uint32_t shift_;               ///< bits of a float below those of its bucket
  std::vector<uint32_t> heads_;  ///< first chunk of each bucket
  uint32_t first_;               ///< upper bits of the first bucket, which also holds all below
  std::vector<Chunk> chunks_;
  uint32_t free_ = kNone;  ///< head of the list of unused chunks
  int64_t current_ = -1;   ///< buckets up to this one are open
  bool opening_ = false;
  std::vector<Candidate> sorted_;
  size_t next_sorted_ = 0;
  std::vector<Candidate> heap_;
};

template <class PushAgain>
Candidate SlopeQueue::pop(PushAgain&& pushAgain) {
  while (openIsEmpty()) openNextBucket(pushAgain);
  return popOpen();
}

template <class PushAgain>
void SlopeQueue::openNextBucket(PushAgain& pushAgain) {
  assert(current_ + 1 < static_cast<int64_t>(heads_.size()));  // else there is no entry left
  uint32_t chunk = heads_[static_cast<size_t>(++current_)];
  if (chunk == kNone) return;
  heads_[static_cast<size_t>(current_)] = kNone;
  sorted_.clear();
  // Where slopes are equal, one bucket holds nearly all vertices: twice as many would be the peak.
  sorted_.reserve(entriesFrom(chunk));
  next_sorted_ = 0;
  opening_ = true;
  while (chunk != kNone) {
    const Chunk taken = chunks_[chunk];
    chunks_[chunk].next = free_;
    free_ = chunk;
    chunk = taken.next;
    if (chunk != kNone) __builtin_prefetch(&chunks_[chunk]);
    pushAgain(std::span(taken.vertices).first(taken.count));
  }
  opening_ = false;
  sortOpened();
}

}  // namespace tetrakis::inline decimation
