// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/knots.hpp"

#include <cstddef>
#include <utility>

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

namespace {

class KnotDecimation {
 public:
  KnotDecimation(const Curve& curve, const KnotCost& cost)
      : curve_(curve),
        cost_(cost),
        left_(curve.size()),
        entry_(curve.size(), 1),
        waiting_(CountedLess{&operations_}),
        places_(curve.size(), waiting_.end()) {}

  Polylines run() && {
    const uint32_t last = curve_.size() - 1;
    for (uint32_t k = 1; k < last; ++k) wait(k);
    for (uint32_t segments = last; segments > 1; --segments) {
      const uint32_t k = waiting_.begin()->second;
      waiting_.erase(waiting_.begin());
      entry_[k] = segments;
      const uint32_t a = left_.before(k), b = left_.after(k);
      left_.remove(k);
      if (a != 0) renew(a);
      if (b != last) renew(b);
    }
    return nestedPolylines(curve_, std::move(entry_), operations_);
  }

 private:
  void wait(uint32_t k) {
    ++operations_.errors;
    places_[k] = waiting_.emplace(cost_(left_.before(k), k, left_.after(k)), k);
  }

  void renew(uint32_t k) {
    waiting_.erase(places_[k]);
    wait(k);
  }

  const Curve& curve_;
  const KnotCost& cost_;
  LinkedKnots left_;
  std::vector<uint32_t> entry_;
  Operations operations_;
  SortedKnots waiting_;
  std::vector<SortedKnots::iterator> places_;  ///< of the knots that wait
};

}  // namespace

Polylines decimateKnots(const Curve& curve, const KnotCost& cost) {
  return KnotDecimation(curve, cost).run();
}

}  // namespace tetrakis::inline polyline
