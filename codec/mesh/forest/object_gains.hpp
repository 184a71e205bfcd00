// SPDX-License-Identifier: Apache-2.0
// coordinatesOfErrors() takes the places of an object's samples and makes the rasters by which the
// vertices of its meshes are chosen.
//
// Triangles that lie beside their samples, but in the surface, show the same surface: errors count
// along its normal. That of a whole patch is taken, so that a raster of heights along it has the
// gains of heights (forest_mesh.hpp). Where a patch bends far away from its normal, errors along
// the three axes count as well, by a part.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::inline forest {

/// x, y and z of the samples of a raster, at most 2^30 each.
using ObjectRasters = std::array<std::vector<int32_t>, 3>;

/// Heights along the normals of patches, then parts of x, y and z. The same bits on every machine.
std::array<std::vector<int32_t>, 4> coordinatesOfErrors(const Forest& forest,
                                                        const ObjectRasters& places);

}  // namespace tetrakis::inline forest
