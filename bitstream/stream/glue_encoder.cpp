// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/glue.hpp"
#include "bitstream/stream/glue_pass.hpp"

namespace tetrakis::inline stream {

std::string encodeGlue(const std::vector<uint32_t>& sides) {
  DecisionEncoding io;
  std::vector<uint32_t> copy = sides;
  GluePass pass(io, static_cast<uint32_t>(sides.size() / Forest::kSides));
  pass.run(copy);
  const std::vector<uint8_t> bytes = io.finish();
  return {bytes.begin(), bytes.end()};
}

std::vector<MetPatch> patchesAsMet(const std::vector<uint32_t>& sides) {
  const auto patches = static_cast<uint32_t>(sides.size() / Forest::kSides);
  ForestWalk walk(patches);
  std::vector<uint8_t> seen(patches);
  std::vector<MetPatch> met;
  const auto meet = [&](uint32_t patch, uint32_t entered) {
    seen[patch] = 1;
    met.push_back({patch, entered});
  };
  for (uint32_t first = 0; first < patches; ++first) {
    if (seen[first] != 0) continue;
    meet(first, 0);
    walk.meet(Forest::kSides * first);
    while (const auto side = walk.front()) {
      const uint32_t other = sides[*side];
      if (other == Forest::kBorder) {
        walk.makeBorder(*side);
      } else {
        if (seen[other / Forest::kSides] == 0) {
          meet(other / Forest::kSides, other % Forest::kSides);
          walk.meet(other);
        }
        walk.glue(*side, other);
      }
    }
  }
  return met;
}

}  // namespace tetrakis::inline stream
