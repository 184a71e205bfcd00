// SPDX-License-Identifier: Apache-2.0
// udecimate(), udecimateGlobal(), cdecimate() and cglobal(): the knot that is worth least goes
// first (thesis 2.4, 2.5), without and with a tree.
#include <cstddef>
#include <utility>

#include "codec/polyline/knots.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {

// udecimate and its sibling by global error. The thesis's cost of a knot is its own squared
// distance to the chord of its neighbours (2.4); that of the sibling is all that the knot's removal
// adds to (2.1), which knots that went before have a part in.

Polylines udecimate(const Curve& curve) {
  return decimateKnots(
      curve, [&](uint32_t a, uint32_t k, uint32_t b) { return curve.deviation(a, k, b); });
}

Polylines udecimateGlobal(const Curve& curve) {
  return decimateKnots(curve,
                       [&](uint32_t a, uint32_t k, uint32_t b) { return curve.gain(a, k, b); });
}

// cdecimate: greedy decimation along the tree (thesis 2.5.2, fig. 2.16). The leaves wait in a
// sorted list; a knot becomes a leaf when both of its children are gone.

Polylines cdecimate(const Curve& curve) {
  const KnotTree tree(curve.size());
  Operations operations;
  SortedKnots waiting(CountedLess{&operations});
  std::vector<uint8_t> children(curve.size(), 0);
  const auto wait = [&](uint32_t k) {
    ++operations.errors;
    waiting.emplace(curve.deviation(tree[k].a, k, tree[k].b), k);
  };
  for (const uint32_t k : tree.order()) {
    children[k] = static_cast<uint8_t>((tree[k].left != kNoKnot) + (tree[k].right != kNoKnot));
    if (children[k] == 0) wait(k);
  }
  std::vector<uint32_t> entry(curve.size(), 1);
  for (uint32_t segments = curve.size() - 1; !waiting.empty(); --segments) {
    const uint32_t k = waiting.begin()->second, parent = tree[k].parent;
    waiting.erase(waiting.begin());
    entry[k] = segments;
    if (parent == kNoKnot) continue;
    ++operations.comparisons;  // "sibling check"
    if (--children[parent] == 0) wait(parent);
  }
  return nestedPolylines(curve, std::move(entry), operations);
}

// cglobal: decimation along the tree by global error (thesis 2.5.4, table 2.2, fig. 2.19).
//
// The thesis keeps, at each node, the error that removing its whole subtree adds, subtracts from it
// what descendants took with them as they went (2.41), and the best leaf of the subtree. What is
// left at a leaf is then what its removal adds now. With g = E(a, b) - E(a, k) - E(k, b) the error
// of a subtree is the sum of its knots' g, so the subtraction leaves g itself: it need not be done.

namespace {

class GlobalDecimation {
 public:
  explicit GlobalDecimation(const Curve& curve)
      : curve_(curve), tree_(curve.size()), gains_(curve.size()), best_(curve.size(), kNoKnot) {}

  Polylines run() && {
    const std::vector<uint32_t>& order = tree_.order();
    for (size_t p = order.size(); p-- > 0;) {
      const uint32_t k = order[p];
      gains_[k] = curve_.gain(tree_[k].a, k, tree_[k].b);
      ++operations_.errors;
      choose(k);
    }
    std::vector<uint32_t> entry(curve_.size(), 1);
    for (uint32_t segments = curve_.size() - 1; segments > 1; --segments) {
      const uint32_t k = best_[tree_.root()];
      entry[k] = segments;
      best_[k] = kNoKnot;
      for (uint32_t up = tree_[k].parent; up != kNoKnot; up = tree_[up].parent) choose(up);
    }
    return nestedPolylines(curve_, std::move(entry), operations_);
  }

 private:
  /// The cheapest leaf of what is left below k, or k itself where nothing is.
  void choose(uint32_t k) {
    const uint32_t left = bestOf(tree_[k].left), right = bestOf(tree_[k].right);
    operations_.comparisons += left != kNoKnot && right != kNoKnot;
    ++operations_.updates;
    if (left == kNoKnot && right == kNoKnot) {
      best_[k] = k;
    } else if (right == kNoKnot || (left != kNoKnot && gains_[left] <= gains_[right])) {
      best_[k] = left;
    } else {
      best_[k] = right;
    }
  }

  uint32_t bestOf(uint32_t k) const { return k == kNoKnot ? kNoKnot : best_[k]; }

  const Curve& curve_;
  KnotTree tree_;
  std::vector<double> gains_;
  std::vector<uint32_t> best_;  ///< by knot, of its subtree; kNoKnot: nothing is left of that
  Operations operations_;
};

}  // namespace

Polylines cglobal(const Curve& curve) {
  return GlobalDecimation(curve).run();
}

}  // namespace tetrakis::inline polyline
