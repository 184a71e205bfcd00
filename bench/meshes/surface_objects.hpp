// SPDX-License-Identifier: Apache-2.0
// What surfaces take as objects of Tetrakis.
#pragma once

#include "bench/meshes/rate_envelope.hpp"
#include "codec/remesh/triangle_mesh.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Whole streams without a texture, of 1500 bytes to 64 kB. Errors are those that the encoder
/// reports, in 1e-4 of the mesh's diagonal. Numbers of bytes that are too few for any stream are
/// left out.
Result<ErrorCurve> surfaceObjects(const TriangleMesh& mesh);

}  // namespace tetrakis::bench
