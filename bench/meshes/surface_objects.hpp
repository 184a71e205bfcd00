// SPDX-License-Identifier: Apache-2.0
// What surfaces take as objects of Tetrakis.
#pragma once

#include <cstdint>

#include "bench/meshes/rate_envelope.hpp"
#include "codec/remesh/triangle_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Which streams are made.
struct ObjectSettings {
  uint64_t fewest = 1500, most = 64 << 10;  ///< bytes of them
  double ratio = 1.5;                       ///< of one to the one before, above 1
};

/// Whole streams without a texture. Errors are those that the encoder reports, in 1e-4 of the
/// mesh's diagonal. Numbers of bytes that are too few for any stream are left out.
Result<ErrorCurve> surfaceObjects(const TriangleMesh& mesh, const ObjectSettings& settings);

}  // namespace tetrakis::bench
