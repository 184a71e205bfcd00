// SPDX-License-Identifier: Apache-2.0
// The texture of a surface as an image of its own: what another mesh with texture coordinates
// would need beside them.
#pragma once

#include "apps/tools/files/files.hpp"
#include "bench/meshes/rate_envelope.hpp"
#include "bench/meshes/surface_model.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// The image of the model. Texels that no triangle shows go on smoothly from those around, which
/// takes the fewest bytes.
tools::ImageFile filledAtlas(const SurfaceModel& model);

/// Prefixes of one stream of Tetrakis. Errors are RMS of R, G and B on the surface of the model,
/// with its own texture coordinates.
Result<ErrorCurve> tetrakisAtlas(const SurfaceModel& model, const tools::ImageFile& atlas);

/// The same of files of avifenc (libaom, 4:4:4, tuned for PSNR, speed 6). TKS_UNSUPPORTED: there is
/// no such program.
Result<ErrorCurve> avifAtlas(const SurfaceModel& model, const tools::ImageFile& atlas);

}  // namespace tetrakis::bench
