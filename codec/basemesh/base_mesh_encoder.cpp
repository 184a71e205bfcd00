// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/range_encoder.hpp"
#include "codec/basemesh/base_mesh.hpp"
#include "codec/basemesh/corner_pass.hpp"

namespace tetrakis::inline basemesh {

BaseMeshHeader encodeBaseMesh(const BaseMesh& mesh) {
  DecisionEncoding io;
  std::vector<Cell> corners = mesh.corners;
  CornerPass(io, *mesh.forest, mesh.bits).run(corners);
  const std::vector<uint8_t> code = io.finish();
  return {static_cast<uint8_t>(mesh.bits), mesh.cell, mesh.origin, {code.begin(), code.end()}};
}

}  // namespace tetrakis::inline basemesh
