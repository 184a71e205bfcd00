// SPDX-License-Identifier: Apache-2.0
// Vertices by slope: a lazy queue whose entries are lower bounds of the slopes that vertices have
// now.
//
// Slopes at the front rise, so few entries need a heap at any time:
//   sorted   the first entry of every vertex, sorted once, 8 bytes each (slope rounded down to
//   float); buckets  later entries, by the upper 16 bits of their slope: 128 buckets for each power
//   of two; heap     later entries of the buckets up to the current one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/lattice.hpp"

namespace tetrakis {

/// Slope first; among equal slopes the coarser vertex, whose merging domain holds the finer ones.
struct Candidate {
  double slope = 0;
  VertexId vertex = 0;
  auto operator<=>(const Candidate&) const = default;
};

class SlopeQueue {
 public:
  /// slopes: one for each vertex, no NaN.
  explicit SlopeQueue(std::span<const double> slopes);

  /// The least entry. The queue is not empty.
  Candidate pop();
  void push(const Candidate& candidate);
  /// Whether the candidate comes before every entry.
  bool isBeforeAll(const Candidate& candidate);

 private:
  struct Entry {
    double slope;
    VertexId vertex;
    uint32_t next;
  };

  bool sortedIsEmpty() const { return next_sorted_ == sorted_.size(); }
  Candidate sortedFront() const;
  void fillHeap();
  void openBucket(uint32_t bucket);

  std::vector<uint64_t>
      sorted_;  ///< ordered bits of the float in the upper half, vertex in the lower
  size_t next_sorted_ = 0;
  std::vector<uint32_t> buckets_;  ///< heads of linked lists of entries
  std::vector<Entry> entries_;
  uint32_t free_;         ///< head of the list of unused entries
  uint32_t current_ = 0;  ///< buckets up to this one are in the heap
  std::vector<Candidate> heap_;
};

}  // namespace tetrakis
