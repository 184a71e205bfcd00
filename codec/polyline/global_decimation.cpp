// SPDX-License-Identifier: Apache-2.0
// cglobal: decimation along the tree by global error (thesis 2.5.4, table 2.2, fig. 2.19).
//
// The thesis keeps, at each node, the error that removing its whole subtree adds, subtracts from it
// what descendants took with them as they went (2.41), and the best leaf of the subtree. What is
// left at a leaf is then what its removal adds now. With g = E(a, b) - E(a, k) - E(k, b) the error
// of a subtree is the sum of its knots' g, so the subtraction leaves g itself: it need not be done.
#include <cstddef>
#include <utility>

#include "codec/polyline/algorithms.hpp"
#include "codec/polyline/knot_tree.hpp"

namespace tetrakis::inline polyline {
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
