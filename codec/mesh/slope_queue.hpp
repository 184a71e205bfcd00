// SPDX-License-Identifier: Apache-2.0
// Vertices by slope: a lazy queue. An entry is a lower bound of the slope that its vertex has now.
//
// Slopes at the front hardly ever fall, so most entries need no order yet:
//   later   vertices alone, by the upper bits of their slope as a float: 128 buckets (fewer where
//           there are few vertices) for each of the greatest 56 powers of two, each a list of
//           chunks of one cache line;
//   open    the candidates of the buckets up to the current one: those that were there when it was
//           opened, sorted, and a heap of those that came since.
// A bucket is opened by handing its vertices back to the caller, who pushes those that are still
// there with the slopes that they have by then: most stale entries never meet a comparison.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/lattice.hpp"

namespace tetrakis {

/// Slope first; among equal slopes the coarser vertex, whose merging domain holds the finer ones.
struct Candidate {
  double slope = 0;
  VertexId vertex = 0;
  auto operator<=>(const Candidate&) const = default;
};

class SlopeQueue {
 public:
  /// greatest: no finite slope is greater; 0 if none is positive. vertices: about how many there
  /// will be.
  SlopeQueue(double greatest, size_t vertices);

  /// slope: no NaN. Returns a bound: a slope below it needs an entry of its own.
  float push(const Candidate& candidate);
  /// The least entry. Entries remain; pushAgain(std::span<const VertexId>) is called with the
  /// vertices of a bucket that is opened, some at a time, and may push them.
  template <class PushAgain>
  Candidate pop(PushAgain&& pushAgain);
  /// Whether the candidate, popped just now or of a slope risen since, comes before every entry.
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
  uint32_t chunk = heads_[static_cast<size_t>(++current_)];
  if (chunk == kNone) return;
  heads_[static_cast<size_t>(current_)] = kNone;
  sorted_.clear();
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

}  // namespace tetrakis
