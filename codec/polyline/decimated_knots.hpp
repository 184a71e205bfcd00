// SPDX-License-Identifier: Apache-2.0
// decimateKnots() removes the knots of a curve greedily (thesis 2.4, fig. 2.8, appendix 2.D),
// without a tree, for any cost of a knot between its neighbours.
#pragma once

#include <functional>

#include "codec/polyline/curve.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {

/// What it costs to remove knot k between its neighbours a and b.
using KnotCost = std::function<double(uint32_t a, uint32_t k, uint32_t b)>;

/// Removes the cheapest knot until none but the ends is left. The costs of the neighbours of a
/// knot that goes are renewed.
Polylines decimateKnots(const Curve& curve, const KnotCost& cost);

}  // namespace tetrakis::inline polyline
