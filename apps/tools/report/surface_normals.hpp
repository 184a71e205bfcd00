// SPDX-License-Identifier: Apache-2.0
// surfaceNormals() and normalMap() compute normals of the decoded surface of a terrain, for
// vertices and as a map. They show more detail than the mesh has. joinedNormals() computes those of
// a mesh that is cut open where its texture has seams.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// The mip level of heights whose surface meshes take their normals from: the finest of at most
/// 2^24 samples, which is the whole surface up to 4096 x 4096.
uint32_t normalLevel(const tks_info& whole);

/// Three numbers a vertex in the axes of MeshFile, of length 1: the surface's slopes by central
/// differences at the samples of level 0 given (y * width + x). Voids are left out; straight up
/// where nothing is known. Leaves the decoder at level 0 of heights and texture.
Result<std::vector<float>> surfaceNormals(Decoder& decoder, std::span<const uint32_t> samples);

/// The normals of all samples of the level that is set, in the tangent space of flat ground as glTF
/// has it: red along rows (east, where the first row is the northern one), green up in the picture
/// (north), blue up; 8 bits, -1 to 1 as 0 to 255. copies: bytes that have to fit beside.
Result<ImageFile> normalMap(Decoder& decoder, uint64_t copies);

/// Three numbers a vertex, of length 1: the sum over the triangles at its place, each weighing its
/// area. Vertices with equal positions (three numbers each) have the same normal, so that light
/// falls in the same way on both sides of a seam. (0, 1, 0) where no triangle has an area.
std::vector<float> joinedNormals(std::span<const double> positions,
                                 std::span<const uint32_t> triangles);

}  // namespace tetrakis::tools
