// SPDX-License-Identifier: Apache-2.0
// PairGraph tells which triangles of a mesh may be paired to quads, and how bad the quads would be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/remesh/cubic_matching.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct PairGraph {
  /// For each triangle those beyond its sides 0, 1 and 2. kNoMate where there is none that could be
  /// a mate: at the border, and where the other triangle has the same three corners.
  CubicGraph neighbours;
  /// The badness of the quad with each neighbour. Where there is none: the badness of the quad that
  /// the triangle alone becomes if that side is halved.
  std::vector<std::array<double, 3>> badness;
  /// For each triangle the side that is halved if it is alone; 3 if it must not be alone.
  std::vector<uint8_t> halved;
  std::vector<bool> at_border;  ///< for each point: whether a side without a neighbour ends there
};

PairGraph pairGraph(const TriangleMesh& mesh);

/// Tells how far a quad is from a flat square, which has 0. A quad with a corner of 180 degrees has
/// at least 1/4. Degenerate quads have finite values too.
double quadBadness(const std::array<Point, 4>& corners);

/// The side of `triangle` beyond which its neighbour `mate` lies. If `mate` is `triangle` itself:
/// the side that is halved.
size_t sideTowards(const PairGraph& graph, uint32_t triangle, uint32_t mate);

}  // namespace tetrakis::inline remesh
