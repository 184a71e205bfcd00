// SPDX-License-Identifier: Apache-2.0
// ShrinkingMesh is a manifold whose points can be collapsed into their neighbours, one after the
// other, each in constant time. Triangles keep their numbers until they vanish.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/remesh/half_edges.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// The triangles around a point, counter-clockwise. Triangle i is (centre, points[i], points[i +
/// 1]). In a closed ring the first point follows on the last one. The ring of a point on the
/// boundary is open: it has one point more than triangles.
struct Ring {
  uint32_t centre = 0;
  bool closed = true;
  std::vector<uint32_t> sides;   ///< for triangle i its half-edge from the centre to points[i]
  std::vector<uint32_t> points;  ///< the neighbours of the centre

  uint32_t triangles() const { return static_cast<uint32_t>(sides.size()); }
  uint32_t next(uint32_t i) const { return i + 1 < points.size() ? i + 1 : 0; }
};

class ShrinkingMesh {
 public:
  /// Points with more neighbours than that have no rings, so that a collapse takes constant time.
  static constexpr uint32_t kMostNeighbours = 32;

  explicit ShrinkingMesh(const TriangleMesh& mesh);

  uint32_t triangleCount() const { return triangle_count_; }
  /// How many neighbours a point has.
  uint32_t neighbours(uint32_t point) const { return neighbours_[point]; }

  /// Sets `ring` to the ring of a point. False if the point is gone or has too many neighbours.
  bool findRing(uint32_t point, Ring& ring) const;

  /// Whether the surface stays a manifold of the same topology, and every component keeps at least
  /// two triangles, when the centre moves to points[target]: the link condition.
  bool keepsTopology(const Ring& ring, uint32_t target) const;

  /// Moves the centre to points[target]. The triangles around it that do not vanish keep their
  /// numbers and the order of their corners.
  void collapse(const Ring& ring, uint32_t target);

 private:
  bool adjacent(uint32_t a, uint32_t b) const;
  void glue(uint32_t side, uint32_t other);
  void removeTriangle(const Ring& ring, uint32_t i, uint32_t heir);

  std::vector<Triangle> triangles_;
  std::vector<uint32_t> opposite_;
  /// For each point a half-edge from it: the one on the boundary if there is one.
  std::vector<uint32_t> first_side_;
  std::vector<uint32_t> neighbours_;  ///< for each point how many it has; 0: the point is gone
  uint32_t triangle_count_;
};

}  // namespace tetrakis::inline remesh
