// SPDX-License-Identifier: Apache-2.0
// encodeMeshopt() compresses a mesh as the streams of EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/tools/compression/mesh_arrays.hpp"

namespace tetrakis::tools {

/// One buffer view: `count` items of `stride` bytes once decoded.
struct MeshoptStream {
  std::vector<std::byte> bytes;
  size_t count = 0, stride = 0;
};

/// Triangles and vertices in the order in which they code best; vertices that no triangle has are
/// dropped.
struct MeshoptMesh {
  MeshoptStream positions;  ///< mode ATTRIBUTES, filter EXPONENTIAL: 3 floats
  MeshoptStream normals;    ///< ATTRIBUTES, OCTAHEDRAL: 4 normalised bytes, of which 3 count
  MeshoptStream texcoords;  ///< ATTRIBUTES, no filter: 2 normalised 16-bit numbers; empty if none
  MeshoptStream triangles;  ///< TRIANGLES: indices of 2 bytes up to 65535 vertices, else of 4
  MeshBounds bounds;        ///< of the positions that decoders give
};

/// Positions within half of positionSteps, and multiples of powers of two: equal coordinates on
/// meshes of equal steps stay equal.
MeshoptMesh encodeMeshopt(const MeshArrays& mesh);

}  // namespace tetrakis::tools
