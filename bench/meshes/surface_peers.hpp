// SPDX-License-Identifier: Apache-2.0
// What surfaces take today: meshes simplified by meshoptimizer, coded by Draco.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/meshes/rate_envelope.hpp"
#include "codec/remesh/triangle_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// What is tried on each mesh.
struct PeerSettings {
  uint32_t sizes = 10;                   ///< numbers of triangles, evenly spaced by logarithm
  uint32_t fewest = 250, most = 120000;  ///< but no more than the mesh has
  uint32_t coarsest_bits = 8, finest_bits = 12;  ///< of positions
};

/// A Draco buffer of a mesh and its errors.
struct PeerCoding {
  uint32_t triangles = 0;  ///< of the simplified mesh
  uint32_t bits = 0;
  ErrorPoint point;  ///< bytes of the buffer; error in 1e-4 of the mesh's diagonal
};

/// Of positions alone, by edgebreaker at the slowest speed, errors measured on what is decoded
/// (mesh_distance.hpp). The mesh has an area and no equal points.
Result<std::vector<PeerCoding>> surfacePeers(const TriangleMesh& mesh,
                                             const PeerSettings& settings);

}  // namespace tetrakis::bench
