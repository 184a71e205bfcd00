// SPDX-License-Identifier: Apache-2.0
// encodeDraco() compresses a mesh as one Draco buffer, for KHR_draco_mesh_compression.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/tools/compression/mesh_arrays.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Draco orders vertices and triangles anew, and merges or drops what is equal or has no area: what
/// a decoder gives is said here.
struct DracoMesh {
  std::vector<std::byte> bytes;
  size_t vertices = 0, triangles = 0;
  MeshBounds bounds;
  /// Unique ids of the attributes; that of texture coordinates means nothing without any.
  uint32_t position = 0, normal = 0, texcoord = 0;
};

/// Positions within half of positionSteps on every axis, normals of 8 bits (within a degree),
/// texture coordinates of 16. TKS_LIMIT: Draco does not take the mesh.
Result<DracoMesh> encodeDraco(const MeshArrays& mesh);

}  // namespace tetrakis::tools
