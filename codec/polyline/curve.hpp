// SPDX-License-Identifier: Apache-2.0
// Curve holds the knots of a curve and tells the error of each chord between two of them (thesis
// 2.1.2, 2.1.4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis::inline polyline {

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

}  // namespace tetrakis::inline polyline
