// SPDX-License-Identifier: Apache-2.0
// closedRound() takes a mesh of a grid whose columns go round a globe, which is open between the
// last column and the first one and at both ends, and closes it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline globe {

/// A grid whose last column lies beside its first one.
struct RoundGrid {
  uint32_t width = 0, height = 0;
  /// In which row the poles before the first row and behind the last one lie: of rows of areas at
  /// -0.5 and height - 0.5, of rows that are poles at 0 and height - 1. Nothing: the grid ends
  /// before the pole, and so does its mesh.
  std::optional<double> first_pole = {}, last_pole = {};
};

/// Where a vertex lies on the grid. (0, 0) is the first sample.
struct GridPlace {
  double column = 0, row = 0;
};

/// A mesh that is cut open once more, so that a texture can be laid over it: vertices of the first
/// column come twice, in the columns 0 and `width`, and a pole once for each of its triangles, in
/// the middle column of the other two corners. Vertices that lie on one place of the globe have the
/// same height; taken for one, no edge is open but around voids and at ends without a pole.
struct GlobeMesh {
  std::vector<GridPlace> places;
  std::vector<float> heights;
  std::vector<uint32_t> triangles;  ///< counter-clockwise as on the grid; every vertex is of one
};

/// Joins the last column to the first one by triangles between their vertices, all of which are
/// used, and rows to their poles by fans. A row that is a pole becomes one point. A pole is as high
/// as its row in the mean. mesh: covers the grid; heights: of its vertices, NaN where they are
/// void: no triangle has such a corner.
GlobeMesh closedRound(const LatticeMesh& mesh, std::span<const float> heights,
                      const RoundGrid& grid);

}  // namespace tetrakis::inline globe
