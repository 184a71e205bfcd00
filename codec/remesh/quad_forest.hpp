// SPDX-License-Identifier: Apache-2.0
// quadForest() makes a forest of quads: a patch for each, whose sides are glued where two quads
// have an edge in opposite directions. Patches are numbered and turned so that their glue takes few
// bits.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/pairing.hpp"

namespace tetrakis::inline remesh {

/// Patch p of the forest is quad `quads[p]`.
struct QuadForest {
  std::vector<uint32_t> sides;  ///< as of Forest
  std::vector<uint32_t> quads;
  /// Which corner of its quad lies in the north-west of a patch. The others follow clockwise, which
  /// is against the order of the quad.
  std::vector<uint8_t> first_corners;

  /// The corner of its quad that is the north-west, north-east, south-east or south-west one of a
  /// patch: 0 to 3.
  uint32_t quadCorner(uint32_t patch, uint32_t corner) const {
    return (first_corners[patch] + 4 - corner) % 4;
  }
};

/// Where more than two quads have an edge, it is a border of all of them.
QuadForest quadForest(std::span<const Quad> quads);

}  // namespace tetrakis::inline remesh
