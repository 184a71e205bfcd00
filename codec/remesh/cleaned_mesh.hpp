// SPDX-License-Identifier: Apache-2.0
// cleaned() makes an oriented manifold with boundary of any triangles. A file may hold points
// several times, triangles without area, triangles that lie on each other, edges where three sheets
// meet, neighbours that face opposite sides, and cones that touch at their tips. Algorithms that
// walk from triangle to triangle can handle none of these. Edges and points are cut as by Guéziec,
// Taubin, Lazarus and Horn (Cutting and stitching, 2001). Of the triangles that have an area only
// those are dropped that lie on another one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// Where a triangle comes from: its corner k was corner `corners[k]` of triangle `triangle` of the
/// input.
struct TriangleSource {
  uint32_t triangle = 0;
  std::array<uint8_t, 3> corners{0, 1, 2};
};

struct CleaningReport {
  uint32_t degenerate = 0;  ///< dropped triangles that had two corners in one place
  uint32_t doubled = 0;     ///< dropped triangles that had the same corners as an earlier one
  /// Edges that were cut: three or more triangles met there, or two that cannot face one side.
  uint32_t cut_edges = 0;
};

struct CleanedMesh {
  /// Each edge has one or two triangles. The triangles of each point form one fan.
  TriangleMesh mesh;
  std::vector<TriangleSource> sources;  ///< one for each triangle, in the order of the input
  CleaningReport report;
};

/// Coordinates must be finite, and numbers of points in range. Triangles without area stay if their
/// three corners differ: without them the surface would have cracks. Each component faces the side
/// that most of its triangles faced.
CleanedMesh cleaned(const TriangleMesh& input);

}  // namespace tetrakis::inline remesh
