// SPDX-License-Identifier: Apache-2.0
// withTurnedEdges() turns edges of a fitted mesh, so that its triangles follow ridges and valleys
// of any direction.
//
// The edges of a 4-8 mesh have eight directions, so it takes many small triangles along a crest
// that has another one. Here two triangles that share an edge become the other two of their four
// corners wherever that errs less (data-dependent triangulation: Dyn, Levin and Rippa 1990), and
// heights are fitted anew. Vertices and the number of triangles stay; the mesh is no longer one of
// the lattice.
#pragma once

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline mesh {

/// The mesh with its edges turned and its heights fitted anew. The squared error over the known
/// samples never grows. Triangles stay counter-clockwise, cover the same ground and have an area;
/// those that touch an unknown sample stay as they are. The same bits with every compiler. mesh:
/// its vertices are samples of the surface.
FittedMesh withTurnedEdges(const WeightedSurface& surface, FittedMesh mesh);

}  // namespace tetrakis::inline mesh
