// SPDX-License-Identifier: Apache-2.0
// The functions here make the image of a mesh what its surface shows.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"

namespace tetrakis::tools {

/// The image without its alpha: grey or RGB. A further colour is left out as well.
ImageFile withoutAlpha(const ImageFile& image);

/// The texture of a mesh that has one, without its alpha, multiplied by the mesh's base colour.
/// That is a factor of light where glTF gives it, and of the values that are stored where others
/// do.
/// Black counts as white: programs write it beside textures, which would leave nothing of them.
ImageFile shownTexture(const SurfaceFile& surface);

}  // namespace tetrakis::tools
