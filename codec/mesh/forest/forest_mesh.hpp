// SPDX-License-Identifier: Apache-2.0
// forestBudgetVertices() chooses the vertices of the best mesh of a forest within a budget of
// triangles, and forestGains() what each of them takes off the error of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/forest/forest_lattice.hpp"

namespace tetrakis::inline forest {

/// The coordinates of the samples of a raster in which errors count: heights over a plane or a
/// globe, or x, y and z of an object.
using Coordinates = std::span<const std::span<const int32_t>>;

/// What each vertex takes off the squared error of a mesh, in squared steps (thesis 5.3): the sum
/// over the patches that it splits triangles of, and over the coordinates.
std::vector<double> forestGains(const ForestLattice& lattice, Coordinates coordinates);
inline std::vector<double> forestGains(const ForestLattice& lattice,
                                       std::span<const int32_t> heights) {
  return forestGains(lattice, Coordinates(&heights, 1));
}

/// A closed set whose mesh has at most max_triangles triangles, or none of the vertices where that
/// is less than the base mesh has. Up to the last corner of the convex hull of all meshes below
/// that number it is the best set there is (closure/closure.hpp); the triangles that are left go to
/// vertices of the next corner, coarse ones first. It chooses among every 2^k-th sample of each
/// patch if many more are left for each triangle.
std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                               Coordinates coordinates, uint32_t max_triangles);

inline std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                                      std::span<const int32_t> heights,
                                                      uint32_t max_triangles) {
  return forestBudgetVertices(lattice, Coordinates(&heights, 1), max_triangles);
}

/// The bytes that meshes of a forest take at most beside its heights.
uint64_t forestMeshBytes(const Forest& forest);

}  // namespace tetrakis::inline forest
