// SPDX-License-Identifier: Apache-2.0
// cleaned() makes an oriented manifold with boundary of any triangles. A file may hold points
// several times, triangles that are lines, faces that lie on each other, edges where three sheets
// meet, faces that look to different sides, and cones that touch in their tips; what walks from
// triangle to triangle can do with none of them. It is the cutting of Guéziec, Taubin, Lazarus
// and Horn (Cutting and stitching, 2001), and no triangle of positive area is lost but doubles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// Where a triangle comes from: its corner k was corner `corners[k]` of a triangle of the input.
struct TriangleSource {
  uint32_t triangle = 0;
  std::array<uint8_t, 3> corners{0, 1, 2};
};

struct CleaningReport {
  uint32_t welded = 0;      ///< points that lie where a point before them lies
  uint32_t degenerate = 0;  ///< dropped triangles, two of whose corners are one point
  uint32_t doubled = 0;     ///< dropped triangles with the corners of one before them
  uint32_t cut_edges = 0;   ///< of three or more triangles, or with one side of the surface on both
  uint32_t split_points = 0;  ///< copies that had to be made so that each point has one fan
  uint32_t flipped = 0;       ///< triangles that were turned round
};

struct CleanedMesh {
  TriangleMesh mesh;                    ///< each edge has one or two triangles, each point one fan
  std::vector<TriangleSource> sources;  ///< one a triangle, in the order of the input
  CleaningReport report;
};

/// Points must be finite, and numbers of points in range. Triangles of no area stay, if their
/// corners are three points: without them the surface would have cracks. A component looks to the
/// side to which most of its triangles looked.
CleanedMesh cleaned(const TriangleMesh& input);

}  // namespace tetrakis::inline remesh
