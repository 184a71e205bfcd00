// SPDX-License-Identifier: Apache-2.0
// Quadric is the weighted sum of the squared distances of a point to some planes, as a function of
// the point (Garland, Heckbert 1997).
#pragma once

#include <algorithm>
#include <array>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

class Quadric {
 public:
  /// Adds the plane through `point` that is at right angles to `normal`, whose length is 1.
  void addPlane(const Point& normal, const Point& point, double weight) {
    const std::array<double, 4> plane{normal[0], normal[1], normal[2], -dot(normal, point)};
    for (size_t row = 0, k = 0; row < 4; ++row) {
      for (size_t column = row; column < 4; ++column)
        terms_[k++] += weight * plane[row] * plane[column];
    }
  }

  void add(const Quadric& other) {
    for (size_t k = 0; k < terms_.size(); ++k) terms_[k] += other.terms_[k];
  }

  /// The sum at a point; rounding cannot make it negative.
  double at(const Point& p) const {
    const auto& t = terms_;
    const double value = p[0] * (t[0] * p[0] + 2 * (t[1] * p[1] + t[2] * p[2] + t[3])) +
                         p[1] * (t[4] * p[1] + 2 * (t[5] * p[2] + t[6])) +
                         p[2] * (t[7] * p[2] + 2 * t[8]) + t[9];
    return std::max(0.0, value);
  }

 private:
  std::array<double, 10> terms_{};  // the upper triangle of a symmetric 4 x 4 matrix
};

}  // namespace tetrakis::inline remesh
