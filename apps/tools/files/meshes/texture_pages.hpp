// SPDX-License-Identifier: Apache-2.0
// pageTextures() puts the textures and colours of all parts of a mesh into one image, a page for
// each look, since a mesh of a stream has one texture. Scans have several textures, models a
// material for each part, and many scanners give each vertex a colour.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/meshes/mesh_import.hpp"

namespace tetrakis::tools {

struct TexturePages {
  ImageFile image;                              ///< RGB of 8 bits, as the surface shows them
  std::vector<std::array<float, 2>> texcoords;  ///< 3 a triangle, (0, 0) at the top left corner
  std::vector<std::string> remarks;             ///< what was joined, or left out and why
};

/// mesh: of several looks. A texture that repeats on a triangle stands in its page several times,
/// up to kMostRepeats along each axis. One that cannot be read, or does not fit, gives way to the
/// colour of its material.
TexturePages pageTextures(const MeshImport& mesh, const std::string& mesh_path);

}  // namespace tetrakis::tools
