// SPDX-License-Identifier: Apache-2.0
// What bounds the triangles of a node of a TriangleTree: a box along the axes, and where triangles
// are needles, a box that is turned along them as well. Boxes around needles that lie across the
// axes are nearly empty, and many of them overlap: of the 100 000 triangles around the tip of a
// cone a place would lie in the boxes of a quarter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "codec/remesh/triangle_mesh.hpp"
#include "codec/remesh/triangle_queries.hpp"

namespace tetrakis::inline remesh {

/// A box whose sides have any directions.
struct TurnedBox {
  std::array<Point, 3> axes;  ///< at right angles, of length 1
  Point origin{};             ///< a point near by
  Box box;                    ///< in coordinates along these axes from there

  Point direction(const Point& of) const {
    return {dot(axes[0], of), dot(axes[1], of), dot(axes[2], of)};
  }
  Point place(const Point& of) const { return direction(of - origin); }
  void add(const Point& point) { box.add({place(point), place(point)}); }
};

inline constexpr double kNeedle = 16;  ///< the length of a needle, in parts of its width

/// The square of the length of a triangle's longest side, if the triangle is a needle, and else 0.
inline double needleSquare(const TriangleMesh& mesh, const Triangle& t) {
  double longest = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Point side = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
    longest = std::max(longest, dot(side, side));
  }
  return kNeedle * length(areaNormal(mesh, t)) < longest ? longest : 0;
}

/// An empty box along the longest side of a triangle, across it, and along its normal; none if the
/// triangle has no area.
inline std::optional<TurnedBox> boxAlong(const TriangleMesh& mesh, const Triangle& t) {
  Point longest{};
  for (size_t k = 0; k < 3; ++k) {
    const Point side = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
    if (dot(side, side) > dot(longest, longest)) longest = side;
  }
  const Point along = 1 / length(longest) * longest;
  const Point normal = cross(along, areaNormal(mesh, t)), across = cross(along, normal);
  const double size = length(normal);
  if (!(size > 0) || !std::isfinite(size)) return {};
  return TurnedBox{{along, 1 / size * normal, 1 / length(across) * across}, mesh.points[t[0]], {}};
}

inline double squaredDistance(const Box& box, const Point& point) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double outside =
        std::max({box.low[axis] - point[axis], point[axis] - box.high[axis], 0.0});
    sum += outside * outside;
  }
  return sum;
}

/// Tells whether a line meets boxes. Where rounding leaves a doubt the answer is true.
class BoxSight {
 public:
  explicit BoxSight(const Line& line) : line_(line) {
    for (size_t axis = 0; axis < 3; ++axis) inverse_[axis] = 1 / line.direction[axis];
  }

  bool meets(const Box& box) const {
    constexpr double kRounding = 1e-15;
    double first = line_.first, last = line_.last;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double low = box.low[axis] - line_.origin[axis];
      const double high = box.high[axis] - line_.origin[axis];
      if (!std::isfinite(inverse_[axis])) {  // the line hardly moves along this axis
        if (line_.direction[axis] == 0 && (low > 0 || high < 0)) return false;
        continue;
      }
      const double a = low * inverse_[axis], b = high * inverse_[axis];
      const double in = std::min(a, b), out = std::max(a, b);
      first = std::max(first, in - kRounding * std::abs(in));
      last = std::min(last, out + kRounding * std::abs(out));
    }
    return first <= last;
  }

  bool meets(const TurnedBox& turned) const {
    const Line line{turned.place(line_.origin), turned.direction(line_.direction), line_.first,
                    line_.last};
    return BoxSight(line).meets(turned.box);
  }

 private:
  const Line line_;
  Point inverse_;
};

}  // namespace tetrakis::inline remesh
