// SPDX-License-Identifier: Apache-2.0
// drapeTexture() sets the texture coordinates of a mesh whose texture has a place of its own: an
// orthophoto that begins elsewhere than the heights, covers more of the ground or less, or is
// turned against them.
#pragma once

#include <cstdint>
#include <span>

#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// grid_indices: of the mesh's vertices. Places beyond the texture get its border. Where the stream
/// does not say how the two lie to each other (apps/tools/files/place/texture_place.hpp) the
/// texture covers the heights from the first sample to the last.
void drapeTexture(const tks_info& info, std::span<const uint32_t> grid_indices, MeshFile& mesh);

}  // namespace tetrakis::tools
