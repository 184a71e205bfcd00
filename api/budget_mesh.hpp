// SPDX-License-Identifier: Apache-2.0
// Meshes of few triangles, from as little of the surface as they can show.
//
// With five samples left for each triangle a mesh is about as good as one chosen among all samples,
// if those left are means (codec/mesh/coarse_surface.hpp) and its heights are fitted to four times
// as many: RMSE of meshes of 1000 to 30000 triangles, 2 to 64 kB of nine terrains, -2.2 to +0.5 %
// of that with twelve samples a triangle (one terrain of 3 m a sample: +2.7 %), of 100 and 300
// triangles -2.6 to +2.9 %. So a decoder makes a mip level and no more, and the time that a mesh
// takes follows its triangles. Levels of which nothing is known are skipped if one sample a
// triangle is left.
#pragma once

#include "api/surface_mesh.hpp"

namespace tetrakis {

/// The mip level of the heights that the mesh is fitted to, or a coarser one.
uint32_t budgetMeshLevel(const Lattice& lattice, uint32_t max_triangles);

/// A mesh of at most max_triangles > 0 of a surface without voids, which the decoder holds.
/// lattice: that of the surface.
Result<SurfaceMesh> budgetMesh(tks_decoder& decoder, Lattice lattice, uint32_t max_triangles);

}  // namespace tetrakis
