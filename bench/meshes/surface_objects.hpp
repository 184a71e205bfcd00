// SPDX-License-Identifier: Apache-2.0
// What surfaces take as objects of Tetrakis.
#pragma once

#include <cstdint>

#include "bench/meshes/rate_envelope.hpp"
#include "bench/meshes/surface_model.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

struct ObjectOptions {
  uint64_t bytes = 0;  ///< of the stream, at most
  tks_object_kind kind = TKS_OBJECT_AUTO;
  bool textured = false;
  bool sketched = false;  ///< with a sketch, if the encoder chooses so; peers have none
};

struct SurfaceObject {
  Buffer stream;
  tks_object_report report;
};

Result<SurfaceObject> surfaceObject(const SurfaceModel& model, const ObjectOptions& options);

/// Whole streams without a texture, of 400 bytes to 64 kB. Errors are those that the encoder
/// reports, in 1e-4 of the mesh's diagonal. Numbers of bytes that are too few for any stream are
/// left out.
Result<ErrorCurve> surfaceObjects(const SurfaceModel& model);

/// The first bytes of a stream, with at most so many triangles (0: of every sample). TKS_CORRUPT
/// or the like where these show nothing.
Result<tools::PaintedMesh> decodedPrefix(std::span<const uint8_t> stream, size_t bytes,
                                         uint32_t max_triangles = 0);

}  // namespace tetrakis::bench
