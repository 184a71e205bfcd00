// SPDX-License-Identifier: Apache-2.0
// compareSurface() measures how far a decoded object is from the mesh that was encoded, and its
// colours from the mesh's own.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "codec/remesh/mesh_distance.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

struct SurfaceMeasurement {
  uint32_t triangles = 0;  ///< of the decoded mesh
  /// Of 20 000 places of either surface to the other one, in the unit of the mesh, of which the
  /// original is the first.
  MeshDistance distance;
  /// In dB, of R, G and B of 255: at those places of either surface, with the colours of the
  /// nearest places of the other one, whichever way is worse. Infinite without error. Nothing where
  /// one of both has no texture.
  std::optional<double> colour_psnr;
};

/// With the mesh of at most max_triangles (0: of every sample). The errors of tks_decode_object and
/// tks_decode_texture.
Result<SurfaceMeasurement> compareSurface(Decoder& decoder, const SurfaceFile& original,
                                          uint32_t max_triangles);

}  // namespace tetrakis::tools
