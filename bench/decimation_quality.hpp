// SPDX-License-Identifier: Apache-2.0
// How good the meshes of one terrain are: against the hull of all 4-8 meshes, against other
// simplifiers at equal triangles, and against their meshes coded by Draco at equal error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/decimation_peers.hpp"
#include "codec/fitted_heights.hpp"

namespace tetrakis::bench {

PlanMesh planMesh(const FittedMesh& fitted, uint32_t width);

struct GapPoint {
  uint32_t triangles = 0;
  double greedy = 0, optimal = 0;  ///< dB of squared error of either order above the hull
};

/// 20 rates from 100 triangles to nine tenths of all, at equal ratios.
Result<std::vector<GapPoint>> gapsToHull(const Raster& raster);

/// Errors at one number of triangles: that of the peer's mesh.
struct MeshPoint {
  std::string peer;
  uint32_t budget = 0;  ///< what the peer was asked for
  uint32_t triangles = 0;
  double peer_rmse = 0, rmse = 0;
};

/// Fitted meshes of the raster itself beside those of the peers.
Result<std::vector<MeshPoint>> comparedMeshes(const Raster& raster,
                                              const std::vector<PeerMesh>& peers);

/// Bytes at one error.
struct BytePoint {
  uint32_t budget = 0;        ///< of Delatin's mesh
  double goal = 0, rmse = 0;  ///< of Delatin's mesh and 0.1 % more; of ours, decoded
  uint64_t peer_bytes = 0, bytes = 0;
  uint32_t peer_triangles = 0, triangles = 0;
};

/// At the error of each of Delatin's meshes: the fewest bytes of any peer, any budget and any
/// setting of Draco that reach it; and the shortest prefix of a stream with its smallest budget
/// mesh.
Result<std::vector<BytePoint>> comparedBytes(const Raster& raster,
                                             const std::vector<PeerMesh>& peers);

}  // namespace tetrakis::bench
