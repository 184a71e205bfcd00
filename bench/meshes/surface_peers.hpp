// SPDX-License-Identifier: Apache-2.0
// What surfaces take today: meshes simplified by meshoptimizer, coded by Draco.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/meshes/rate_envelope.hpp"
#include "codec/remesh/triangle_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// A Draco buffer of a mesh and its errors.
struct PeerCoding {
  uint32_t triangles = 0;  ///< of the simplified mesh
  uint32_t bits = 0;
  ErrorPoint point;  ///< bytes of the buffer; error in 1e-4 of the mesh's diagonal
};

/// Meshes of `sizes` numbers of triangles, from 250 to 120 000, evenly spaced by logarithm, but of
/// no more than the mesh has; each with positions of 8 to 12 bits. Of positions alone, by
/// edgebreaker at the slowest speed, errors measured on what is decoded (mesh_distance.hpp). The
/// mesh has an area and no equal points.
Result<std::vector<PeerCoding>> surfacePeers(const TriangleMesh& mesh, uint32_t sizes);

}  // namespace tetrakis::bench
