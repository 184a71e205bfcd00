// SPDX-License-Identifier: Apache-2.0
// The functions here are the algorithms of thesis chapter 2 that minimise the error D(J) over the
// polylines J of C segments (2.2), and one more. All take a curve of at least two knots and give
// `Polylines`. Table 2.3 states their costs for n knots, m = n - 2 of them between the ends.
//
// The trees of 2.5.1 split the knots a … b at the knot (a + b) / 2, and so on. With n = 2^d + 1
// knots that is the complete tree of (2.29); the code takes any n.
#pragma once

#include <array>
#include <cstdint>

#include "codec/polyline/curve.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {

/// 2.3, appendix 2.B: the best of all polylines for each number of segments, up to `most`, by
/// dynamic programming. Θ(n^2) time and Θ(n) storage a number of segments. Neither nested nor
/// monotone: one segment more can cost error (table 2.1).
Polylines uoptimalUpTo(const Curve& curve, uint32_t most);
Polylines uoptimal(const Curve& curve);

/// 2.4, appendix 2.C: inserts the knot farthest from the polyline. 3 m log m in the mean, m^2 at
/// worst.
Polylines urefine(const Curve& curve);

/// 2.4, appendix 2.D: removes the knot nearest to the chord of its neighbours. 5 m log m.
Polylines udecimate(const Curve& curve);

/// Not in the thesis: this removes the knot that adds least to the error of the whole polyline,
/// knots that are gone included (the global error of 2.5.4, which the thesis has for
/// trees alone). 5 m log m.
Polylines udecimateGlobal(const Curve& curve);

/// 2.5.2: inserts, of the knots whose parents in the tree are in, the one farthest from the
/// polyline. m log m.
Polylines crefine(const Curve& curve);

/// 2.5.2: removes the leaf of the tree that is nearest to the chord of its neighbours. m log m.
Polylines cdecimate(const Curve& curve);

/// 2.5.4: removes the leaf that adds least to the error of the whole polyline. 5 m log m.
Polylines cglobal(const Curve& curve);

/// 2.6: removes the subtree that adds least error for each of its knots (G-BFOS). Monotone: its
/// polylines are the corners of the hull of all polylines that are trees, in the plane of segments
/// and error. 7 m log m. Some numbers of segments have none.
Polylines coptimal(const Curve& curve);

/// A row of table 2.3.
struct Algorithm {
  const char* name;
  Polylines (*run)(const Curve&);
  double factor;            ///< operations: factor · m log2 m; 0: they are cubic
  bool nested, tree_bound;  ///< 2.2.4 and 2.5.1
};

extern const std::array<Algorithm, 8> kAlgorithms;

}  // namespace tetrakis::inline polyline
