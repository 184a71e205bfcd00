// SPDX-License-Identifier: Apache-2.0
// compareWithMesh() is `tetrakis compare` of an object with the mesh that was encoded.
#pragma once

#include <string>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/output/json.hpp"

namespace tetrakis::tools {

/// The original and how it is compared.
struct MeshReference {
  std::string mesh, texture;  ///< files; "": no other texture than that of the mesh
  uint32_t triangles = 0;     ///< of the decoded mesh, at most; 0: every sample
};

/// What `compare` prints. TKS_USAGE: the stream holds no object.
Result<Json> compareWithMesh(OpenStream& stream, const MeshReference& reference, bool quiet);

}  // namespace tetrakis::tools
