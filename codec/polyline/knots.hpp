// SPDX-License-Identifier: Apache-2.0
// LinkedKnots and KnotTree keep the knots of a curve that are left, in their order and as a
// hierarchy, and decimateKnots() removes them one by one: what the algorithms of polylines.hpp are
// made of.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {

// LinkedKnots tells the neighbours of each knot of a curve among the knots that are not yet
// removed.

class LinkedKnots {
 public:
  explicit LinkedKnots(uint32_t count) : links_(count) {
    for (uint32_t k = 0; k < count; ++k) links_[k] = {k - 1, k + 1};
  }

  /// The neighbours that are left of a knot that is left and has such a neighbour.
  uint32_t before(uint32_t knot) const { return links_[knot].before; }
  uint32_t after(uint32_t knot) const { return links_[knot].after; }

  /// knot: not an end.
  void remove(uint32_t knot) {
    const Link link = links_[knot];
    links_[link.before].after = link.after;
    links_[link.after].before = link.before;
  }

 private:
  struct Link {
    uint32_t before = 0, after = 0;
  };
  std::vector<Link> links_;
};

// KnotTree is the hierarchy of knots (thesis 2.5.1, fig. 2.12): a binary tree whose nodes are the
// knots between the ends. A polyline that the tree allows keeps with each knot also its parent.

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

// decimateKnots() removes the knots of a curve greedily (thesis 2.4, fig. 2.8, appendix 2.D),
// without a tree, for any cost of a knot between its neighbours.

/// What it costs to remove knot k between its neighbours a and b.
using KnotCost = std::function<double(uint32_t a, uint32_t k, uint32_t b)>;

/// Removes the cheapest knot until none but the ends is left. The costs of the neighbours of a
/// knot that goes are renewed.
Polylines decimateKnots(const Curve& curve, const KnotCost& cost);

}  // namespace tetrakis::inline polyline
