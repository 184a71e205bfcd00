// SPDX-License-Identifier: Apache-2.0
// Which triangles of a mesh may be paired to quads, and how good the quads would be. Side k of a
// triangle leads from its corner k to the next one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/remesh/cubic_matching.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct PairGraph {
  /// The triangles beyond the three sides. kNoMate, where none can be a mate: at the border, and
  /// where the other triangle has the same corners.
  CubicGraph neighbours;
  /// Of the quads with them. Without a neighbour: of the triangle alone with that side halved.
  std::vector<std::array<double, 3>> badness;
  std::vector<uint8_t> halved;  ///< the side that is halved in a triangle alone; 3: none can be
  std::vector<bool> at_border;  ///< of points: ends of sides without neighbours
};

PairGraph pairGraph(const TriangleMesh& mesh);

/// How far a quad is from a flat square: 0 for one, at least 1/4 if a corner has 180 degrees.
/// Degenerate quads have finite values.
double quadBadness(const std::array<Point, 4>& corners);

/// The side of `triangle` towards `mate`, a neighbour; towards itself the one that would be halved.
size_t sideTowards(const PairGraph& graph, uint32_t triangle, uint32_t mate);

/// Of all quads, alone ones as well.
double totalBadness(const PairGraph& graph, const Matching& matching);

}  // namespace tetrakis::inline remesh
