// SPDX-License-Identifier: Apache-2.0
// CollapsingTriangles is a mesh whose vertices collapse into neighbours, one after the other. A
// Star is what lies around a vertex. The surface keeps its pieces, handles and borders: a collapse
// draws an edge together to a point, and with it the two triangles, or the one, beside it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/trianglemesh/coded_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// The triangles around a vertex, counter-clockwise: triangle i has its corner corners[i] there,
/// then points[i] and points[i + 1]. Where they go round, the first point follows on the last one;
/// else there is one point more than triangles.
struct Star {
  uint32_t centre = 0;
  bool closed = true;
  std::vector<uint32_t> corners, points;

  size_t next(size_t i) const { return i + 1 < points.size() ? i + 1 : 0; }
  size_t last(size_t i) const { return i > 0 ? i - 1 : points.size() - 1; }
  /// Whether points[i] follows on points[other], or that on it.
  bool isBeside(size_t i, size_t other) const {
    return i + 1 == other || other + 1 == i || (closed && (next(i) == other || next(other) == i));
  }
  /// Whether triangle i vanishes if the centre goes to points[target].
  bool vanishes(size_t i, size_t target) const { return i == target || next(i) == target; }
};

/// Which wedges of the target those of a vertex become, by the triangles that vanish between them.
struct WedgeHeirs {
  static constexpr uint32_t kNone = UINT32_MAX;
  std::array<uint32_t, 2> from{kNone, kNone}, to{kNone, kNone};

  /// kNone where no triangle says it, or two say different ones.
  uint32_t of(uint32_t wedge) const {
    if (from[0] == from[1] && to[0] != to[1]) return kNone;
    return wedge == from[0] ? to[0] : wedge == from[1] ? to[1] : kNone;
  }
};

/// What is left of a mesh, by the numbers that it had.
struct LeftTriangles {
  std::vector<uint32_t> triangles;  ///< in the order that they had
  std::vector<uint32_t> vertices;   ///< three of each
};

class CollapsingTriangles {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;  ///< instead of a corner, or a vertex

  explicit CollapsingTriangles(CodedTriangles mesh);

  const CodedTriangles& mesh() const { return mesh_; }
  /// A corner of each vertex, or kNone if the vertex is gone.
  const std::vector<uint32_t>& cornerOf() const { return corner_of_; }
  bool isGone(uint32_t triangle) const { return mesh_.vertices[3 * size_t{triangle}] == kNone; }

  /// False where the vertex is gone, or has too many triangles.
  bool findStar(uint32_t vertex, Star& star) const;

  /// Whether the surface stays what it is if the centre goes to points[target]: a vertex of a
  /// border stays on it, no side of a triangle gets one place as both ends, no triangle comes to
  /// lie on its back, and no piece vanishes. If `strictly`, no two edges get the same ends either
  /// (the link condition); handles can then not become as thin as a line.
  bool keepsSurface(const Star& star, size_t target, bool strictly);

  /// Without a texture there are none.
  WedgeHeirs heirsOf(const Star& star, size_t target) const;

  /// Takes the centre to points[target]. Wedges that have no heir become one of the target's.
  void collapse(const Star& star, size_t target);

  /// Takes a triangle away; what was glued to it is not to be asked for any more.
  void remove(uint32_t triangle) { mesh_.vertices[3 * size_t{triangle}] = kNone; }

  /// What is left, with numbers in the order of first use, without cut sides.
  CodedTriangles rest() const;
  /// The same by the numbers that it had.
  LeftTriangles left() const;

 private:
  uint32_t firstOf(uint32_t begin) const;
  bool keepsEdges(const Star& star, size_t target) const;
  void glue(uint32_t side, uint32_t other) {
    if (side != kBorder) mesh_.sides[side] = other;
  }
  void vanish(const Star& star, size_t i, bool ahead);

  CodedTriangles mesh_;
  std::vector<uint32_t> corner_of_;
  Star beside_;  ///< the star of the last target
};

}  // namespace tetrakis::inline trianglemesh
