// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/glue.hpp"
#include "bitstream/stream/glue_pass.hpp"

namespace tetrakis::inline stream {

std::string encodeGlue(const std::vector<uint32_t>& sides) {
  DecisionEncoding io;
  std::vector<uint32_t> copy = sides;
  GluePass pass(io, static_cast<uint32_t>(sides.size() / Forest::kSides), Forest::kSides);
  pass.run(copy);
  const std::vector<uint8_t> bytes = io.finish();
  return {bytes.begin(), bytes.end()};
}

std::vector<MetFace> facesAsMet(const std::vector<uint32_t>& sides, uint32_t of_face) {
  const auto faces = static_cast<uint32_t>(sides.size() / of_face);
  FaceWalk walk(faces, of_face);
  std::vector<uint8_t> seen(faces);
  std::vector<MetFace> met;
  const auto meet = [&](uint32_t side) {
    seen[side / of_face] = 1;
    met.push_back({side / of_face, side % of_face});
    walk.meet(side);
  };
  for (uint32_t first = 0; first < faces; ++first) {
    if (seen[first] != 0) continue;
    meet(of_face * first);
    while (const auto side = walk.front()) {
      const uint32_t other = sides[*side];
      if (other == Forest::kBorder) {
        walk.makeBorder(*side);
      } else {
        if (seen[other / of_face] == 0) meet(other);
        walk.glue(*side, other);
      }
    }
  }
  return met;
}

}  // namespace tetrakis::inline stream
