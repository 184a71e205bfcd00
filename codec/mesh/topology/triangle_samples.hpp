// SPDX-License-Identifier: Apache-2.0
// TriangleSamples visits the samples in a triangle, row by row, with their edge functions (Pineda
// 1988): e_k is twice the area that a sample spans with the edge opposite corner k; the three add
// up to twice the triangle's area. Samples on an edge belong to the triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline topology {

class TriangleSamples {
 public:
  using Edges = std::array<int64_t, 3>;

  /// Corners in either sense of rotation; the triangle has an area.
  explicit TriangleSamples(const std::array<GridPoint, 3>& corners) {
    for (size_t k = 0; k < 3; ++k) {
      const GridPoint from = corners[(k + 1) % 3], to = corners[(k + 2) % 3];
      across_[k] = int64_t{from.y} - to.y;
      down_[k] = int64_t{to.x} - from.x;
      origin_[k] = -(across_[k] * from.x + down_[k] * from.y);
    }
    const int64_t area = at(corners[0].x, corners[0].y)[0], sign = area < 0 ? -1 : 1;
    assert(area != 0);
    doubled_area_ = area * sign;
    for (size_t k = 0; k < 3; ++k) {
      across_[k] *= sign;
      down_[k] *= sign;
      origin_[k] *= sign;
    }
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    left_ = left;
    right_ = right;
    top_ = top;
    bottom_ = bottom;
  }

  int64_t doubledArea() const { return doubled_area_; }
  /// Edge functions of a sample; one that is negative says that the sample lies beyond that edge.
  Edges at(int64_t x, int64_t y) const {
    Edges e;
    for (size_t k = 0; k < 3; ++k) e[k] = across_[k] * x + down_[k] * y + origin_[k];
    return e;
  }

  /// visit(x, y, Edges)
  template <class Visit>
  void forEach(Visit&& visit) const {
    for (uint32_t y = top_; y <= bottom_; ++y) {
      int64_t first = left_, last = right_;
      const Edges row = at(0, y);
      for (size_t k = 0; k < 3; ++k) {
        if (across_[k] > 0) first = std::max(first, -floorDivide(row[k], across_[k]));
        if (across_[k] < 0) last = std::min(last, floorDivide(row[k], -across_[k]));
      }
      Edges e = at(first, y);
      for (int64_t x = first; x <= last; ++x) {
        visit(static_cast<uint32_t>(x), y, e);
        for (size_t k = 0; k < 3; ++k) e[k] += across_[k];
      }
    }
  }

 private:
  static int64_t floorDivide(int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

  Edges across_, down_, origin_;  ///< e = across x + down y + origin
  int64_t doubled_area_;
  uint32_t left_, right_, top_, bottom_;
};

}  // namespace tetrakis::inline topology
