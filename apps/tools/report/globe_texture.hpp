// SPDX-License-Identifier: Apache-2.0
// layOnCube() lays a texture of longitudes and latitudes over a globe on a cube. Its left border
// meets its right one along a meridian, and its rows shrink to points at the poles: triangles there
// get corners of their own, where the texture goes on beyond its border.
#pragma once

#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// file: the mesh, without texcoords. info: of heights on a cube that were made of a grid, and a
/// texture that does not lie on its patches.
void layOnCube(const tks_info& info, const tks_globe& body, const GlobeMesh& mesh, MeshFile& file);

}  // namespace tetrakis::tools
