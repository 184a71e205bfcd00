// SPDX-License-Identifier: Apache-2.0
// Vertices by slope: a lazy queue whose entries are lower bounds of the slopes that vertices have
// now.
//
// Most vertices leave at the slope they came with. So the first entries are sorted once, as 8 bytes
// each (slope rounded down to float, vertex), and only entries that change go through a heap.
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

  bool empty() const { return next_ == sorted_.size() && heap_.empty(); }
  /// The least entry; the queue is not empty.
  Candidate pop();
  void push(const Candidate& candidate);
  /// Whether the candidate comes before every entry.
  bool isBeforeAll(const Candidate& candidate) const;

 private:
  Candidate front() const;

  std::vector<uint64_t>
      sorted_;  ///< ordered bits of the float in the upper half, vertex in the lower
  size_t next_ = 0;
  std::vector<Candidate> heap_;
};

}  // namespace tetrakis
