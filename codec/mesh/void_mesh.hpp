// SPDX-License-Identifier: Apache-2.0
// verticesBesideVoids() and leaveOutVoids() make a mesh of terrain with voids: none of its vertices
// is void, and none of its triangles touches a void.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/status.hpp"
#include "codec/mesh/fitting/fitted_moments.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline mesh {

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

}  // namespace tetrakis::inline mesh
