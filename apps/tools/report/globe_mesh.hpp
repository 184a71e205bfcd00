// SPDX-License-Identifier: Apache-2.0
// globeMesh() makes a mesh file of a globe: a closed surface round the centre of the body that the
// heights lie on, with the north pole at the top, and layOnCube() gives it texture coordinates.
#pragma once

#include <cstdint>

#include "apps/tools/files/files.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// What to make of the heights of a stream.
struct GlobeRequest {
  bool coded = false;          ///< the mesh that the bytes themselves code
  uint32_t max_triangles = 0;  ///< of the others; 0: every sample
  double exaggeration = 1;     ///< what heights are multiplied by
};

/// The ellipsoid of the CRS, else WGS 84. Without a CRS coordinates are degrees. TKS_USAGE: they
/// are no angles.
Result<tks_globe> globeOf(const tks_info& info, double exaggeration);

/// Positions in metres from the centre: x towards longitude 0, y to the north pole, z towards 90
/// degrees west. The ellipsoid is that of globeOf(). Normals are those of the mesh, the
/// same on both sides of a seam. Texture coordinates are there if the stream has a texture. The
/// errors of tks_decode_globe.
Result<MeshFile> globeMesh(Decoder& decoder, const GlobeRequest& request);

// layOnCube() lays a texture of longitudes and latitudes over a globe on a cube. Its left border
// meets its right one along a meridian, and its rows shrink to points at the poles: triangles there
// get corners of their own, where the texture goes on beyond its border.

/// file: the mesh, without texcoords. info: of heights on a cube that were made of a grid, and a
/// texture that does not lie on its patches.
void layOnCube(const tks_info& info, const tks_globe& body, const GlobeMesh& mesh, MeshFile& file);

}  // namespace tetrakis::tools
