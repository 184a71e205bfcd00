// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/knot_tree.hpp"

#include <cstddef>

namespace tetrakis::inline polyline {

KnotTree::KnotTree(uint32_t knots) : nodes_(knots) {
  order_.reserve(knots);
  add(0, knots - 1, kNoKnot);
  for (size_t p = 0; p < order_.size(); ++p) {
    const uint32_t k = order_[p];
    nodes_[k].left = add(nodes_[k].a, k, k);
    nodes_[k].right = add(k, nodes_[k].b, k);
  }
}

/// The node between a and b, if there is a knot.
uint32_t KnotTree::add(uint32_t a, uint32_t b, uint32_t parent) {
  if (b - a < 2) return kNoKnot;
  const uint32_t k = a + (b - a) / 2;
  nodes_[k] = {a, b, parent, kNoKnot, kNoKnot};
  order_.push_back(k);
  return k;
}

}  // namespace tetrakis::inline polyline
