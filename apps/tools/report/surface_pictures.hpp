// SPDX-License-Identifier: Apache-2.0
// SurfacePictures is what cameras see of the mesh that was encoded as an object, and of the decoded
// object: both with their textures, or both shaded where one has none.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/render/render.hpp"
#include "apps/tools/report/camera_choice.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// Of all points.
Bounds boundsOf(const SurfaceFile& surface);

struct SurfacePictures {
  std::vector<Camera> cameras;
  std::vector<Picture> originals, pictures;  ///< one a camera
};

/// choice: nothing chosen: cameras all around the original. max_triangles: as of compareSurface().
/// Errors: of the renderer, of the camera file, of tks_decode_object and tks_decode_texture;
/// TKS_USAGE if no camera has a weight above 0.
Result<SurfacePictures> drawSurfaces(const SurfaceFile& original, Decoder& decoder,
                                     uint32_t max_triangles, CameraChoice choice);

/// dB over all cameras, by their weights. Infinite without error.
double screenPsnr(const SurfacePictures& drawn);

}  // namespace tetrakis::tools
