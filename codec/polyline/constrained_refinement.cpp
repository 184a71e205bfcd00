// SPDX-License-Identifier: Apache-2.0
// crefine: greedy refinement along the tree (thesis 2.5.2, fig. 2.15). The knots whose parents are
// in wait in a sorted list; each that is inserted lets its two children in.
#include <utility>

#include "codec/polyline/algorithms.hpp"
#include "codec/polyline/knot_tree.hpp"

namespace tetrakis::inline polyline {

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
