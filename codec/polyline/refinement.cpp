// SPDX-License-Identifier: Apache-2.0
// urefine() and crefine(): the knot that is worth most comes first (thesis 2.4, 2.5), without and
// with a tree.
#include <utility>

#include "codec/polyline/knots.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {

// urefine: greedy refinement (thesis 2.4, fig. 2.7, appendix 2.C). The farthest knot of each
// segment waits in a sorted list; the farthest of all is inserted and splits its segment.

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

// crefine: greedy refinement along the tree (thesis 2.5.2, fig. 2.15). The knots whose parents are
// in wait in a sorted list; each that is inserted lets its two children in.

Polylines crefine(const Curve& curve) {
  const KnotTree tree(curve.size());
  Operations operations;
  SortedKnots waiting(CountedLess{&operations});
  const auto wait = [&](uint32_t k) {
    if (k == kNoKnot) return;
    ++operations.errors;
    waiting.emplace(-curve.deviation(tree[k].a, k, tree[k].b), k);  // the farthest comes first
  };
  std::vector<uint32_t> entry(curve.size(), 1);
  wait(tree.root());
  for (uint32_t segments = 2; !waiting.empty(); ++segments) {
    const uint32_t k = waiting.begin()->second;
    waiting.erase(waiting.begin());
    entry[k] = segments;
    wait(tree[k].left);
    wait(tree[k].right);
  }
  return nestedPolylines(curve, std::move(entry), operations);
}

}  // namespace tetrakis::inline polyline
