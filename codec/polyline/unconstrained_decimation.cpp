// SPDX-License-Identifier: Apache-2.0
// udecimate and its sibling by global error. The thesis's cost of a knot is its own squared
// distance to the chord of its neighbours (2.4); that of the sibling is all that the knot's removal
// adds to (2.1), which knots that went before have a part in.
#include "codec/polyline/algorithms.hpp"
#include "codec/polyline/decimated_knots.hpp"

namespace tetrakis::inline polyline {

Polylines udecimate(const Curve& curve) {
  return decimateKnots(
      curve, [&](uint32_t a, uint32_t k, uint32_t b) { return curve.deviation(a, k, b); });
}

Polylines udecimateGlobal(const Curve& curve) {
  return decimateKnots(curve,
                       [&](uint32_t a, uint32_t k, uint32_t b) { return curve.gain(a, k, b); });
}

}  // namespace tetrakis::inline polyline
