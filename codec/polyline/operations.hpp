// SPDX-License-Identifier: Apache-2.0
// Operations counts the work of an algorithm on polylines as the thesis does (2.1.4, appendix 2.A):
// each error that is computed, each comparison and each update is one operation.
#pragma once

#include <cstdint>
#include <set>
#include <utility>

namespace tetrakis::inline polyline {

struct Operations {
  uint64_t errors = 0, comparisons = 0, updates = 0;
  uint64_t total() const { return errors + comparisons + updates; }
};

/// A cost and the knot that has it. Of equal costs the lower knot comes first.
using CostlyKnot = std::pair<double, uint32_t>;

struct CountedLess {
  Operations* count;
  bool operator()(const CostlyKnot& a, const CostlyKnot& b) const {
    ++count->comparisons;
    return a < b;
  }
};

/// The thesis's "sorted vector" of errors: putting one of j knots in takes about log2 j
/// comparisons, which are counted; the least is at hand.
using SortedKnots = std::multiset<CostlyKnot, CountedLess>;

}  // namespace tetrakis::inline polyline
