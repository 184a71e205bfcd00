// SPDX-License-Identifier: Apache-2.0
// coptimal: optimal pruning of the tree (thesis 2.6, figs. 2.21 to 2.24), which is G-BFOS of Chou,
// Lookabaugh and Gray, "Optimal pruning with applications to tree-structured source coding and
// modeling", IEEE Transactions on Information Theory 35, 1989.
//
// Each node keeps what removing all that is left of its subtree adds to the error, how many
// segments that saves, and the node of least slope λ = error / segments in the subtree (2.45). The
// segments are as many as the knots: (2.51) must read |J|, as example 2.1 shows.
#include <cstddef>
#include <utility>

#include "codec/polyline/knots.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {
namespace {

class Pruning {
 public:
  explicit Pruning(const Curve& curve)
      : curve_(curve), tree_(curve.size()), parts_(curve.size()), entry_(curve.size(), 1) {}

  Polylines run() && {
    plant();
    const uint32_t root = tree_.root();
    uint32_t segments = curve_.size() - 1;
    while (root != kNoKnot && parts_[root].segments > 0) {
      const uint32_t k = parts_[root].flattest;
      const Part gone = parts_[k];
      remove(k, segments);
      segments -= gone.segments;
      for (uint32_t up = tree_[k].parent; up != kNoKnot; up = tree_[up].parent) {
        parts_[up].error -= gone.error;
        parts_[up].segments -= gone.segments;
        operations_.updates += 2;
        choose(up);
      }
    }
    return nestedPolylines(curve_, std::move(entry_), operations_);
  }

 private:
  struct Part {
    double error = 0, slope = 0;
    uint32_t segments = 0;  ///< 0: nothing is left of it
    uint32_t flattest = kNoKnot;
  };

  void plant() {
    const std::vector<uint32_t>& order = tree_.order();
    for (size_t p = order.size(); p-- > 0;) {
      const uint32_t k = order[p];
      const KnotNode& node = tree_[k];
      const Part &left = parts_[node.left], &right = parts_[node.right];
      parts_[k].error = curve_.error(node.a, node.b);
      parts_[k].segments = left.segments + right.segments + 1;
      ++operations_.errors;
      ++operations_.updates;
      choose(k);
    }
  }

  /// Finds the subtree of least slope below node k. Of several with that slope it takes the
  /// smallest, so that the sequence of polylines has more members.
  void choose(uint32_t k) {
    Part& part = parts_[k];
    part.slope = part.error / part.segments;
    part.flattest = k;
    ++operations_.updates;
    double least = part.slope;
    for (const uint32_t child : {tree_[k].left, tree_[k].right}) {
      const Part& below = parts_[child];
      if (below.segments == 0) continue;
      ++operations_.comparisons;
      const double slope = parts_[below.flattest].slope;
      if (slope > least || (slope == least && part.flattest != k)) continue;
      least = slope;
      part.flattest = below.flattest;
    }
  }

  /// All that is left of the subtree goes in one step: its knots enter together.
  void remove(uint32_t k, uint32_t segments) {
    if (parts_[k].segments == 0) return;
    parts_[k].segments = 0;
    entry_[k] = segments;
    remove(tree_[k].left, segments);
    remove(tree_[k].right, segments);
  }

  const Curve& curve_;
  KnotTree tree_;
  std::vector<Part> parts_;  ///< by knot; that of kNoKnot stays empty
  std::vector<uint32_t> entry_;
  Operations operations_;
};

}  // namespace

Polylines coptimal(const Curve& curve) {
  return Pruning(curve).run();
}

}  // namespace tetrakis::inline polyline
