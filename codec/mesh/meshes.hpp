// SPDX-License-Identifier: Apache-2.0
// budgetMesh(), screenMesh() and verticesBesideVoids() take a decoded surface and return a mesh of
// at most a given number of triangles: on the map, for a camera, and where some samples are void.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mesh {

// budgetMesh() makes a mesh of at most a given number of triangles from a mip level of a surface.
// Finer levels would take time and show nothing in so few triangles.
//
// With five samples left for each triangle a mesh is about as good as one chosen among all samples,
// if those left are means (surface.hpp) and its heights are fitted to four times as many:
// RMSE of meshes of 1000 to 30000 triangles, 2 to 64 kB of nine terrains, -2.2 to +0.5 % of that
// with twelve samples a triangle (one terrain of 3 m a sample: +2.7 %), of 100 and 300 triangles
// -2.6 to +2.9 %. So a decoder makes one mip level and no more, and the time that a mesh takes
// follows its triangles. Levels of which nothing is known are skipped if one sample a triangle is
// left.

/// The mip level of the heights from which budgetMesh() makes a mesh of at most max_triangles > 0
/// triangles. lattice: that of the whole surface.
uint32_t budgetMeshLevel(const Lattice& lattice, uint32_t max_triangles);

/// A mip level of a surface, as ofMipLevel() makes it.
struct KnownSurface {
  CoarseSurface surface;
  uint32_t level = 0;
  uint32_t quiet_level = 0;  ///< no coefficient of a finer level than this is known; at least level
  /// What squared errors count in each row of the whole surface; empty: 1.
  std::span<const float> row_weights = {};
};

/// A mesh with fitted heights.
struct BudgetMesh {
  std::vector<VertexId> vertices;  ///< the closed set of inserted vertices
  LatticeMesh mesh;                ///< its mesh; vertices are samples of the whole surface
  std::vector<double> heights;     ///< of each vertex of the mesh, in height steps
};

/// The best mesh of at most max_triangles > 0 triangles of a surface without voids. lattice: that
/// of the whole surface. known: level budgetMeshLevel() of the surface. Fails with the errors of
/// FittedSequence::makeFor().
Result<BudgetMesh> budgetMesh(const Lattice& lattice, KnownSurface known, uint32_t max_triangles);

// verticesBesideVoids() and leaveOutVoids() make a mesh of terrain with voids: none of its vertices
// is void, and none of its triangles touches a void.

/// Inserted vertices, and the height of each vertex of their mesh in the steps of the decoder.
struct FittedVertices {
  std::vector<VertexId> vertices;
  std::vector<double> heights;
};

/// The best mesh of at most max_triangles triangles outside the voids of a surface; triangles in
/// voids are still part of it. To decimation voids are a pit whose floor lies a quarter of the
/// range below the lowest height: the wall at the coast keeps vertices along it, where a triangle
/// that reaches into the void would be lost as a whole, and the floor costs nothing. Of a
/// surface without weights, meshes of few triangles are chosen among every 2^k-th sample. Heights
/// are then fitted to all valid samples and to no others. surface: known samples are those that are
/// valid; weights count in voids as well. admits: whether memory suffices for so many triangles,
/// those in voids included; its error is returned.
Result<FittedVertices> verticesBesideVoids(const Lattice& lattice, const WeightedSurface& surface,
                                           uint32_t max_triangles,
                                           const std::function<Status(uint64_t)>& admits);

/// Leaves out vertices whose height is NaN, and the triangles that touch them. The other vertices
/// keep their order. heights: one for each vertex.
void leaveOutVoids(LatticeMesh& mesh, std::vector<float>& heights);

// screenMesh() makes a mesh of few triangles for a surface with weights
// (screen/surface_picture.hpp), whose edges turn to follow ridges and valleys.

/// A mesh of at most max_triangles > 0 triangles whose vertices are those of a 4-8 mesh, chosen
/// among all samples by their weighted error and fitted, and whose edges are then turned
/// (fitted_heights.hpp). Where samples are unknown it is that of verticesBesideVoids(), and
/// triangles in voids are part of it. admits: as verticesBesideVoids() takes it. Fails with the
/// errors of FittedSequence::makeFor().
Result<FittedMesh> screenMesh(const Lattice& lattice, const WeightedSurface& surface,
                              uint32_t max_triangles,
                              const std::function<Status(uint64_t)>& admits);

}  // namespace tetrakis::inline mesh
