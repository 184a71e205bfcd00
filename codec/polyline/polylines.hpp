// SPDX-License-Identifier: Apache-2.0
// Polylines is the result of every algorithm: a polyline for each number of segments that the
// algorithm reaches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/polyline/curve.hpp"
#include "codec/polyline/operations.hpp"

namespace tetrakis::inline polyline {

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

/// Nested polylines with their errors. entry: as above, 1 for both ends.
Polylines nestedPolylines(const Curve& curve, std::vector<uint32_t> entry,
                          const Operations& operations);

/// The error of the polyline over these knots, which begin and end with those of the curve.
double errorOf(const Curve& curve, std::span<const uint32_t> knots);

}  // namespace tetrakis::inline polyline
