// SPDX-License-Identifier: Apache-2.0
// Meshes of terrain with voids: no vertex is void, no triangle touches one.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "codec/geometry/geometry_decoder.hpp"
#include "codec/mesh/lattice.hpp"
#include "codec/mesh/lattice_mesh.hpp"

namespace tetrakis {

/// Inserted vertices, and the height of each vertex of their mesh in the steps of the decoder.
struct FittedVertices {
  std::vector<VertexId> vertices;
  std::vector<double> heights;
};

/// The best mesh of at most max_triangles for a surface with voids, which are still in it. To
/// decimation they are a pit, a quarter of the range below the lowest height: the wall at the coast
/// keeps vertices along it, where a triangle that reaches into the void would be lost as a whole;
/// the floor costs nothing. Heights are then fitted to the valid samples alone.
/// admits: whether memory suffices for so many triangles, those in voids included.
Result<FittedVertices> verticesBesideVoids(const Lattice& lattice, const DecodedGeometry& geometry,
                                           uint32_t max_triangles,
                                           const std::function<Status(uint64_t)>& admits);

/// Leaves out vertices whose height is NaN, and the triangles that touch them. The other vertices
/// keep their order. heights: one for each vertex.
void leaveOutVoids(LatticeMesh& mesh, std::vector<float>& heights);

}  // namespace tetrakis
