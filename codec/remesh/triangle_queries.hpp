// SPDX-License-Identifier: Apache-2.0
// Where one triangle is nearest to a point, and where a line meets it.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// A place of a mesh, and how far from a given point it is.
struct NearPlace {
  SurfacePoint place;
  double distance = 0;
};

/// The place of a triangle of `mesh` that is nearest to `point`. The triangle may be degenerate.
NearPlace nearestInTriangle(const TriangleMesh& mesh, uint32_t triangle, const Point& point);

/// The points origin + t · direction with first <= t <= last. The ends may be infinite.
struct Line {
  Point origin{};
  Point direction{};  ///< of any length but 0
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
};

/// Where a line meets a triangle.
struct Crossing {
  double t = 0;
  SurfacePoint place;
  bool outward = false;  ///< the line leaves the inside here: direction · normal > 0
};

/// Finds where a line meets triangles. It sees them along the line, sheared, so that the line is
/// the origin of a plane: three signs of areas there tell whether it passes a triangle. Triangles
/// with a common side get the same area with opposite signs, so no line slips through between them
/// (Woop, Benthin, Wald, "Watertight ray/triangle intersection", 2013).
class LineSight {
 public:
  explicit LineSight(const Line& line);

  /// Sides and corners belong to the triangle. A line in its plane misses it, and every line misses
  /// a degenerate triangle.
  std::optional<Crossing> crossing(const TriangleMesh& mesh, uint32_t triangle) const;

 private:
  Point sheared(const Point& point) const;  ///< the last coordinate is t

  Line line_;
  std::array<size_t, 3> axes_{};  ///< the last is the one along which the line is steepest
  double across_ = 0, up_ = 0;  ///< how far the line moves in the others while that one grows by 1
};

}  // namespace tetrakis::inline remesh
