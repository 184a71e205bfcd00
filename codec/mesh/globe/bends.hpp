// SPDX-License-Identifier: Apache-2.0
// addBends() gives a mesh the vertices that it needs to be bent round a globe. On a plane a sea is
// a few large triangles; on a globe they would cut through the ground.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline globe {

/// The first level whose vertices a mesh round a globe can do without: squares of the levels before
/// are no longer than 1/64 of the turn (an edge of 5.6 degrees lies 0.12 % of the radius below the
/// sphere), or twice or four times that, up to 1/8, where half of max_triangles would not do. 0:
/// any number of triangles.
uint32_t bendLevel(const Lattice& lattice, uint32_t max_triangles);

/// The same of a cube of that depth, all of whose patches have the lattice of a square.
uint32_t cubeBendLevel(uint32_t depth, uint32_t max_triangles);

/// Adds the vertices of all levels before `level`. The surface stays as it is: they lie on the
/// edges that they split. inserted: the closed set that `mesh` is made of; heights: of its
/// vertices, NaN where they are void, or lie in a void of the surface as a new one may. valid: of
/// all samples of the grid.
void addBends(const Lattice& lattice, std::span<const VertexId> inserted, uint32_t level,
              Mask valid, LatticeMesh& mesh, std::vector<float>& heights);

}  // namespace tetrakis::inline globe
