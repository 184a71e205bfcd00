// SPDX-License-Identifier: Apache-2.0
// Polylines approximate a curve with few of its knots. Each algorithm takes a Curve and returns
// Polylines, one for each number of segments, so that profiles and the thesis's table 2.3 can
// compare them by error and Operations.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace tetrakis::inline polyline {

// Curve holds the knots of a curve and tells the error of each chord between two of them (thesis
// 2.1.2, 2.1.4).

/// Knots with ascending places x and heights y; at least two of them. A polyline keeps some of the
/// knots, both ends always. Its error (2.1) is the sum over the knots that it leaves out of the
/// squared vertical distance to the chord above or below them.
///
/// Prefix sums of 1, x, x^2, y, y^2 and xy give the error of any chord in constant time. Places and
/// heights are taken from their means first, so that the squares differ as little as they can.
class Curve {
 public:
  /// The knots of the thesis: at 0, 1, 2, …
  explicit Curve(std::span<const double> heights);
  /// places: ascending, as many as heights.
  Curve(std::span<const double> places, std::span<const double> heights);

  uint32_t size() const { return static_cast<uint32_t>(knots_.size()); }

  /// E(a, b): the error of the chord between knots a < b. 0 where no knot lies between them.
  double error(uint32_t a, uint32_t b) const;

  /// The squared vertical distance of knot k to the chord between a < b.
  double deviation(uint32_t a, uint32_t k, uint32_t b) const;

  /// What knot k between a and b takes off the error: E(a, b) - E(a, k) - E(k, b). It may be
  /// negative: a knot more can make a polyline worse (table 2.1).
  double gain(uint32_t a, uint32_t k, uint32_t b) const;

 private:
  struct Knot {
    double x = 0, y = 0;
  };
  /// Over all knots before one.
  struct Sums {
    double x = 0, xx = 0, y = 0, yy = 0, xy = 0;
  };
  std::vector<Knot> knots_;
  std::vector<Sums> before_;  ///< size() + 1 of them
};

// Operations counts the work of an algorithm on polylines as the thesis does (2.1.4, appendix 2.A):
// each error that is computed, each comparison and each update is one operation.

struct Operations {
  uint64_t errors = 0, comparisons = 0, updates = 0;
  uint64_t total() const { return errors + comparisons + updates; }
};

/// A cost and the knot that has it. Of equal costs the lower knot comes first.
using CostlyKnot = std::pair<double, uint32_t>;

struct CountedLess {
  Operations* count;
  bool operator()(const CostlyKnot& a, const CostlyKnot& b) const {
    ++count->comparisons;
    return a < b;
  }
};

/// The thesis's "sorted vector" of errors: putting one of j knots in takes about log2 j
/// comparisons, which are counted; the least is at hand.
using SortedKnots = std::multiset<CostlyKnot, CountedLess>;

// Polylines is the result of every algorithm: a polyline for each number of segments that the
// algorithm reaches.

/// Polylines of one curve. The cost C of thesis 2.1.2 is the number of segments, 1 … size() - 1.
struct Polylines {
  /// errors[c]: of the polyline of c segments; NaN where the algorithm has none (c = 0 always).
  std::vector<double> errors;

  /// Where polylines are nested (2.4), knot k is in those of entry[k] segments and more. Else
  /// empty.
  std::vector<uint32_t> entry;

  /// Where polylines are not nested, before[c][k] is the knot ahead of k in the best polyline of c
  /// segments from knot 0 to knot k. Else empty.
  std::vector<std::vector<uint32_t>> before;

  Operations operations;

  bool has(uint32_t segments) const;

  /// The most segments, but at most `segments` (at least 1), that there is a polyline of.
  uint32_t reached(uint32_t segments) const;

  /// The knots of the polyline of so many segments, which there must be, ascending, with both ends.
  std::vector<uint32_t> knots(uint32_t segments) const;
};

/// Nested polylines with their errors. entry: as in Polylines, 1 for both ends.
Polylines nestedPolylines(const Curve& curve, std::vector<uint32_t> entry,
                          const Operations& operations);

/// The error of the polyline over these knots, which begin and end with those of the curve.
double errorOf(const Curve& curve, std::span<const uint32_t> knots);

// The algorithms of thesis chapter 2 minimise the error D(J) over the polylines J of C segments
// (2.2); udecimateGlobal() is one more. All take a curve of at least two knots and give
// `Polylines`. Table 2.3 states their costs for n knots, m = n - 2 of them between the ends.
//
// The trees of 2.5.1 split the knots a … b at the knot (a + b) / 2, and so on. With n = 2^d + 1
// knots that is the complete tree of (2.29); the code takes any n.

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
/// knots that are gone included (the global error of 2.5.4, which the thesis has for trees alone).
/// 5 m log m.
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
