// SPDX-License-Identifier: Apache-2.0
// cdecimate: greedy decimation along the tree (thesis 2.5.2, fig. 2.16). The leaves wait in a
// sorted list; a knot becomes a leaf when both of its children are gone.
#include <utility>

#include "codec/polyline/algorithms.hpp"
#include "codec/polyline/knot_tree.hpp"

namespace tetrakis::inline polyline {

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

}  // namespace tetrakis::inline polyline
