// SPDX-License-Identifier: Apache-2.0
// SeamPass codes the seams of a texture: sides that it is cut along, so that corners which are one
// vertex lie at several places of it. Seams are lines, which go on from side to side.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/trianglemesh/corner_fans.hpp"

namespace tetrakis::inline trianglemesh {

/// Io: as of coder/value_table_pass.hpp; a decision that does not count is false.
template <class Io>
class SeamPass {
 public:
  /// sides, fans: of vertices; outlive this.
  SeamPass(Io& io, const std::vector<uint32_t>& sides, const CornerFans& fans)
      : io_(io), sides_(sides), fans_(fans), vertices_(fans.first.size()) {
    forEachPair([&](uint32_t side) {
      for (const uint32_t end : {side, after(side)}) ++at(end).untold;
    });
  }

  /// cut: of the encoder the sides with seams as borders; of the decoder all of them, of which it
  /// makes seams borders.
  void run(std::vector<uint32_t>& cut) {
    forEachPair([&](uint32_t side) {
      const bool is_seam = io_.decide(modelOf(side), cut[side] == kBorder);
      for (const uint32_t end : {side, after(side)}) {
        --at(end).untold;
        at(end).seams += is_seam;
      }
      if (is_seam) cut[side] = cut[sides_[side]] = kBorder;
    });
  }

 private:
  struct Vertex {
    uint32_t seams = 0;   ///< that are known to meet there
    uint32_t untold = 0;  ///< sides that may be seams
  };
  static constexpr uint32_t kMostSeams = 2, kMostUntold = 3;  ///< more are not told apart
  static constexpr size_t kStates = (kMostSeams + 1) * kMostUntold;

  /// With the lower one of two sides that are glued.
  template <class Visit>
  void forEachPair(Visit&& visit) const {
    for (uint32_t side = 0; side < sides_.size(); ++side)
      if (sides_[side] != kBorder && side < sides_[side]) visit(side);
  }

  Vertex& at(uint32_t corner) { return vertices_[fans_.of_corner[corner]]; }

  uint32_t stateOf(uint32_t corner) {
    const Vertex& vertex = at(corner);
    return kMostUntold * std::min(vertex.seams, kMostSeams) + std::min(vertex.untold, kMostUntold) -
           1;
  }

  AdaptiveBit& modelOf(uint32_t side) {
    const auto [low, high] = std::minmax({stateOf(side), stateOf(after(side))});
    return models_[low][high];
  }

  Io& io_;
  const std::vector<uint32_t>& sides_;
  const CornerFans& fans_;
  std::vector<Vertex> vertices_;
  std::array<std::array<AdaptiveBit, kStates>, kStates> models_;
};

}  // namespace tetrakis::inline trianglemesh
