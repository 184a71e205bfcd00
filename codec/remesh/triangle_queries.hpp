// SPDX-License-Identifier: Apache-2.0
// nearestInTriangle() finds the place of a triangle that is nearest to a point, and LineSight where
// a line meets a triangle.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// A place of a mesh, and its distance from a given point.
struct NearPlace {
  SurfacePoint place;
  double distance = 0;
};

/// The place of a triangle of `mesh` that is nearest to `point`. The triangle may have no area.
NearPlace nearestInTriangle(const TriangleMesh& mesh, uint32_t triangle, const Point& point);

/// The points origin + t · direction with first <= t <= last, which may be infinite.
struct Line {
  Point origin{};
  Point direction{};  ///< its length may be any but 0
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
};

/// Where a line meets a triangle.
struct Crossing {
  double t = 0;
  SurfacePoint place;
  bool outward = false;  ///< whether the line leaves the inside here: direction · normal > 0
};

/// Finds where a line meets triangles. It shears space so that the line becomes an axis, and
/// projects triangles along it to a plane, in which the line is the origin. The signs of three
/// areas there tell whether the line passes through a triangle. Two triangles with a common side
/// get the same area for it with opposite signs, so that no line slips through between them (Woop,
/// Benthin, Wald, "Watertight ray/triangle intersection", 2013).
class LineSight {
 public:
  explicit LineSight(const Line& line);

  /// Where the line meets a triangle, whose sides and corners belong to it. A line in the plane of
  /// a triangle misses it, and every line misses a triangle without area.
  std::optional<Crossing> crossing(const TriangleMesh& mesh, uint32_t triangle) const;

 private:
  Point sheared(const Point& point) const;  ///< two coordinates in the plane, then t

  Line line_;
  std::array<size_t, 3> axes_{};  ///< the last one is that along which the line moves fastest
  double across_ = 0, up_ = 0;    ///< how far it moves along the others, for 1 along the last one
};

}  // namespace tetrakis::inline remesh
