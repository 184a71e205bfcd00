// SPDX-License-Identifier: Apache-2.0
// gluedTriangles() tells how the triangles of a mesh of a forest lie side by side: within a patch
// by the samples that they share, across a side of a patch as the forest glues it. Samples alone do
// not say it, since two edges may join the same two of them: those of two patches that have two
// corners in common, say their diagonals. singleEdges() names the vertices that part such edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/forest/forest_lattice.hpp"

namespace tetrakis::inline forest {

/// Corner 3t + i of triangle t is where its side 3t + i begins, counter-clockwise.
struct GluedTriangles {
  static constexpr uint32_t kBorder = UINT32_MAX;  ///< of a side: no other triangle lies there

  std::vector<uint32_t> samples;  ///< of each corner, in the raster of its patch
  std::vector<uint32_t> sides;    ///< the one that each is glued to, or kBorder
};

/// The mesh of a closed set of vertices, without the triangles that touch an unknown sample. known:
/// of the raster; empty: all.
GluedTriangles gluedTriangles(const ForestLattice& lattice, std::span<const ForestVertex> vertices,
                              std::span<const uint8_t> known = {});

/// The smallest closed set found whose mesh has no two edges between the same two vertices, as far
/// as the samples allow. A mesh with these vertices and others has none either: each further vertex
/// splits an edge, and comes to lie between two different ones.
std::vector<ForestVertex> singleEdges(const ForestLattice& lattice);

}  // namespace tetrakis::inline forest
