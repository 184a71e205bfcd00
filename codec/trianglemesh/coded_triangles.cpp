// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/coded_triangles.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "codec/trianglemesh/triangle_pass.hpp"

namespace tetrakis::inline trianglemesh {

Result<CodedTriangles> decodeTriangles(const TriangleMeshHeader& header) {
  const std::string& code = header.code;
  DecisionDecoding io({reinterpret_cast<const uint8_t*>(code.data()), code.size()});
  CodedTriangles mesh;
  if (!runTriangles(io, header, mesh))
    return Status(TKS_CORRUPT, "Corrupt stream: its triangles do not make a mesh.");
  return mesh;
}

}  // namespace tetrakis::inline trianglemesh
