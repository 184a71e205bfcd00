// SPDX-License-Identifier: Apache-2.0
#include "codec/basemesh/base_mesh.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "codec/basemesh/corner_pass.hpp"

namespace tetrakis::inline basemesh {

std::vector<uint32_t> cornerOwners(const Forest& forest) {
  constexpr std::array<std::array<int64_t, 2>, Forest::kSides> kPlaces = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<uint32_t> owners;
  owners.reserve(size_t{forest.patches()} * Forest::kSides);
  for (uint32_t patch = 0; patch < forest.patches(); ++patch) {
    for (const auto& [x, y] : kPlaces) {
      const Forest::Place owner = forest.owner(1, {patch, x, y});
      const uint32_t corner = owner.y == 0 ? (owner.x == 0 ? 0 : 1) : (owner.x == 0 ? 3 : 2);
      owners.push_back(Forest::kSides * owner.patch + corner);
    }
  }
  return owners;
}

BaseMesh decodeBaseMesh(const BaseMeshHeader& header, const SharedForest& forest) {
  BaseMesh mesh{forest, header.bits, std::vector<Cell>(size_t{forest->patches()} * Forest::kSides),
                header.origin, header.cell};
  const std::string& code = header.code;
  DecisionDecoding io({reinterpret_cast<const uint8_t*>(code.data()), code.size()});
  CornerPass(io, *forest, mesh.bits).run(mesh.corners);
  return mesh;
}

}  // namespace tetrakis::inline basemesh
