// SPDX-License-Identifier: Apache-2.0
// How good the meshes of one terrain are: against the hull of all 4-8 meshes, against other
// simplifiers at equal triangles, and against their meshes coded by Draco at equal error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/meshes/decimation_peers.hpp"
#include "codec/mesh/fitted_heights.hpp"

namespace tetrakis::bench {

PlanMesh planMesh(const FittedMesh& fitted, uint32_t width);

/// dB of squared error above the hull of all 4-8 meshes, near one rate.
struct GapPoint {
  uint32_t corner = 0;   ///< triangles of the hull's corner nearest to the rate: a mesh lies on it
  double at_corner = 0;  ///< of the best prefix there
  uint32_t triangles = 0;
  double to_chord = 0, optimal_to_chord = 0;  ///< at the rate itself, of either order
};

/// 20 rates from 100 triangles to nine tenths of all, at equal ratios. Between two corners the hull
/// is their chord, which no mesh need reach.
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
