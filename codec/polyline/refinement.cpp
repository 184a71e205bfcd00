// SPDX-License-Identifier: Apache-2.0
// urefine: greedy refinement (thesis 2.4, fig. 2.7, appendix 2.C). The farthest knot of each
// segment waits in a sorted list; the farthest of all is inserted and splits its segment.
#include <utility>

#include "codec/polyline/algorithms.hpp"

namespace tetrakis::inline polyline {
namespace {

class Refinement {
 public:
  explicit Refinement(const Curve& curve)
      : curve_(curve),
        chords_(curve.size()),
        entry_(curve.size(), 1),
        waiting_(CountedLess{&operations_}) {}

  Polylines run() && {
    wait(0, curve_.size() - 1);
    for (uint32_t segments = 2; !waiting_.empty(); ++segments) {
      const uint32_t k = waiting_.begin()->second;
      waiting_.erase(waiting_.begin());
      entry_[k] = segments;
      const auto [a, b] = chords_[k];
      wait(a, k);
      wait(k, b);
    }
    return nestedPolylines(curve_, std::move(entry_), operations_);
  }

 private:
  /// Lists the knot between a and b that is farthest from their chord. Costs are negative: the
  /// least comes first.
  void wait(uint32_t a, uint32_t b) {
    if (b - a < 2) return;
    double farthest = -1;
    uint32_t knot = a;
    for (uint32_t k = a + 1; k < b; ++k) {
      const double distance = curve_.deviation(a, k, b);
      if (distance > farthest) {
        farthest = distance;
        knot = k;
      }
    }
    operations_.errors += b - a - 1;
    operations_.comparisons += b - a - 1;
    chords_[knot] = {a, b};
    waiting_.emplace(-farthest, knot);
  }

  const Curve& curve_;
  std::vector<std::pair<uint32_t, uint32_t>> chords_;  ///< of the knots that wait
  std::vector<uint32_t> entry_;
  Operations operations_;
  SortedKnots waiting_;
};

}  // namespace

Polylines urefine(const Curve& curve) {
  return Refinement(curve).run();
}

}  // namespace tetrakis::inline polyline
