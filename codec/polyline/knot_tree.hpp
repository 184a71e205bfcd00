// SPDX-License-Identifier: Apache-2.0
// KnotTree is the hierarchy of knots (thesis 2.5.1, fig. 2.12): a binary tree whose nodes are the
// knots between the ends. A polyline that the tree allows keeps with each knot also its parent.
#pragma once

#include <cstdint>
#include <vector>

namespace tetrakis::inline polyline {

/// No knot: the parent of the root, the children of leaves. (Knot 0 is an end, in no tree.)
inline constexpr uint32_t kNoKnot = 0;

/// A knot's place. While it is a leaf of what is left, its neighbours in the polyline are a and b:
/// each of these is an end of the curve or an ancestor.
struct KnotNode {
  uint32_t a = 0, b = 0;
  uint32_t parent = kNoKnot, left = kNoKnot, right = kNoKnot;
};

class KnotTree {
 public:
  /// The tree of a curve of so many knots, at least two. Between a and b its node is (a + b) / 2.
  explicit KnotTree(uint32_t knots);

  const KnotNode& operator[](uint32_t knot) const { return nodes_[knot]; }

  /// kNoKnot if there are no knots but the ends.
  uint32_t root() const { return order_.empty() ? kNoKnot : order_.front(); }

  /// All nodes, level by level: node p of the thesis is the p-th of them (2.29).
  const std::vector<uint32_t>& order() const { return order_; }

 private:
  uint32_t add(uint32_t a, uint32_t b, uint32_t parent);

  std::vector<KnotNode> nodes_;  ///< by knot
  std::vector<uint32_t> order_;
};

}  // namespace tetrakis::inline polyline
