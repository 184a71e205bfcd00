// SPDX-License-Identifier: Apache-2.0
// budgetMesh() makes a mesh of at most a given number of triangles from a mip level of a surface.
// Finer levels would take time and show nothing in so few triangles.
//
// With five samples left for each triangle a mesh is about as good as one chosen among all samples,
// if those left are means (coarse_surface.hpp) and its heights are fitted to four times as many:
// RMSE of meshes of 1000 to 30000 triangles, 2 to 64 kB of nine terrains, -2.2 to +0.5 % of that
// with twelve samples a triangle (one terrain of 3 m a sample: +2.7 %), of 100 and 300 triangles
// -2.6 to +2.9 %. So a decoder makes one mip level and no more, and the time that a mesh takes
// follows its triangles. Levels of which nothing is known are skipped if one sample a triangle is
// left.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "codec/mesh/surface/coarse_surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline mesh {

/// The mip level of the heights from which budgetMesh() makes a mesh of at most max_triangles > 0
/// triangles. lattice: that of the whole surface.
uint32_t budgetMeshLevel(const Lattice& lattice, uint32_t max_triangles);

/// A mip level of a surface, as ofMipLevel() makes it.
struct KnownSurface {
  CoarseSurface surface;
  uint32_t level = 0;
  uint32_t quiet_level = 0;  ///< no coefficient of a finer level than this is known; at least level
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

}  // namespace tetrakis::inline mesh
