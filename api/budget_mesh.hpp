// SPDX-License-Identifier: Apache-2.0
// Meshes of few triangles, from as little of the surface as they can show.
//
// With five samples left for each triangle a mesh is as good as one chosen among all samples, if
// those left are means (codec/coarse_surface.hpp) and its heights are fitted to four times as many:
// over five terrains, 300 to 10000 triangles, 2 and 64 kB, its RMSE is within -0.6 to +0.7 % of
// that of meshes chosen with twelve samples a triangle. So a decoder makes a mip level and no more,
// and the time that a mesh takes follows its triangles. Where nothing is known of a level it is
// skipped even with two samples a triangle.
#pragma once

#include "api/surface_mesh.hpp"

namespace tetrakis {

/// A mesh of at most max_triangles > 0 of a surface without voids, which the decoder holds.
/// lattice: that of the surface.
Result<SurfaceMesh> budgetMesh(tks_decoder& decoder, Lattice lattice, uint32_t max_triangles);

}  // namespace tetrakis
