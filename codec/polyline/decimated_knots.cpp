// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/decimated_knots.hpp"

#include <utility>

#include "codec/polyline/linked_knots.hpp"

namespace tetrakis::inline polyline {
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
