// SPDX-License-Identifier: Apache-2.0
// PaintedMesh is a mesh of triangles with an image on it, and colourError() tells how far the
// colours of two such meshes are apart.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "codec/remesh/triangle_tree.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

struct PaintedMesh {
  TriangleMesh mesh;
  std::vector<std::array<float, 2>> texcoords;  ///< three a triangle; the image repeats beyond it
  std::optional<ImageFile> image;
};

/// The mean squared error of R, G and B, of 255, at 20 000 places of one mesh, to the colours of
/// the nearest places of the other one, whose tree it is. Both have an image.
double colourError(const PaintedMesh& from, const PaintedMesh& to, const TriangleTree& tree);

/// The same where one mesh has two images.
double colourError(const PaintedMesh& painted, const ImageFile& other);

/// In dB; infinite without error.
double colourPsnr(double error);

/// A decoded object with at most max_triangles (0: of every sample). The errors of
/// tks_decode_object and tks_decode_texture.
Result<PaintedMesh> decodedMesh(Decoder& decoder, uint32_t max_triangles);

}  // namespace tetrakis::tools
