// SPDX-License-Identifier: Apache-2.0
// What surfaces take today: meshes simplified by meshoptimizer, coded by Draco.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/meshes/rate_envelope.hpp"
#include "bench/meshes/surface_model.hpp"
#include "bench/meshes/surface_simplified.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// A Draco buffer of a mesh and its errors.
struct PeerCoding {
  uint32_t triangles = 0;  ///< of the simplified mesh
  uint32_t bits = 0;
  ErrorPoint point;  ///< bytes of the buffer; error in 1e-4 of the model's diagonal
};

/// Meshes of `sizes` numbers of triangles (budgetsOf()), by edgebreaker at the slowest speed;
/// errors are measured on what is decoded. mesh: of the model, without texture coordinates, with
/// positions of 8 to 12 bits; or with texture coordinates of 11 bits and positions of 10 to 14.
Result<std::vector<PeerCoding>> surfacePeers(const SurfaceModel& model, const FloatMesh& mesh,
                                             uint32_t sizes);

/// One for each precision: the sizes of a curve have others between them, its precision has not.
std::vector<ErrorCurve> curvesOf(const std::vector<PeerCoding>& codings);

}  // namespace tetrakis::bench
