// SPDX-License-Identifier: Apache-2.0
// forestBudgetVertices() chooses the vertices of the best mesh of a forest within a budget of
// triangles, forestGains() says what each of them takes off the error of a mesh, and
// fittedHeights() moves the heights of a mesh to the least squares.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/forest/forest_lattice.hpp"

namespace tetrakis::inline forest {

/// The coordinates of the samples of a raster in which errors count: heights over a plane or a
/// globe, or x, y and z of an object.
using Coordinates = std::span<const std::span<const int32_t>>;

/// What squared errors count at each sample of a patch, alike in all patches; empty: 1.
using PatchWeights = std::span<const float>;

/// What each vertex takes off the squared error of a mesh, in squared steps (thesis 5.3): the sum
/// over the patches that it splits triangles of, and over the coordinates.
std::vector<double> forestGains(const ForestLattice& lattice, Coordinates coordinates,
                                PatchWeights weights = {});
inline std::vector<double> forestGains(const ForestLattice& lattice,
                                       std::span<const int32_t> heights,
                                       PatchWeights weights = {}) {
  return forestGains(lattice, Coordinates(&heights, 1), weights);
}

/// The finest levels that a choice of so few triangles can leave out. More samples for each would
/// choose better meshes, and take time. Vertices of the lattice that is left have the numbers that
/// they have on the whole one.
int spareLevels(const Forest& forest, uint32_t max_triangles);

/// A closed set whose mesh has at most max_triangles triangles, or none of the vertices where that
/// is less than the base mesh has. Up to the last corner of the convex hull of all meshes below
/// that number it is the best set there is (closure/closure.hpp); the triangles that are left go to
/// vertices of the next corner, coarse ones first. It chooses among the samples that spareLevels()
/// leaves.
std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                               Coordinates coordinates, uint32_t max_triangles,
                                               PatchWeights weights = {});
inline std::vector<ForestVertex> forestBudgetVertices(const ForestLattice& lattice,
                                                      std::span<const int32_t> heights,
                                                      uint32_t max_triangles,
                                                      PatchWeights weights = {}) {
  return forestBudgetVertices(lattice, Coordinates(&heights, 1), max_triangles, weights);
}

/// The heights of a raster at which the mesh of a closed set has the least squared error, in steps
/// and within the range of the samples (fitting/fitting.hpp); those of vertices count. known: which
/// samples count; empty: all.
std::vector<double> fittedHeights(const ForestLattice& lattice, std::span<const int32_t> heights,
                                  std::span<const uint8_t> known,
                                  std::span<const ForestVertex> vertices,
                                  PatchWeights weights = {});

/// The bytes that meshes of a forest take at most beside its heights, without fitted heights.
uint64_t forestMeshBytes(const Forest& forest);
/// The same of a mesh of at most so many triangles with fitted heights.
uint64_t fittedMeshBytes(const Forest& forest, uint32_t max_triangles);

}  // namespace tetrakis::inline forest
