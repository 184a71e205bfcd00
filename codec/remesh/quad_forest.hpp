// SPDX-License-Identifier: Apache-2.0
// quadForest() makes a forest of quads. Each quad becomes a patch. Two sides are glued if their
// quads have the same edge in opposite directions. Patches are numbered and turned so that their
// glue takes few bits.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/pairing.hpp"

namespace tetrakis::inline remesh {

/// Patch p of the forest is quad `quads[p]`.
struct QuadForest {
  std::vector<uint32_t> sides;  ///< the argument of Forest: for each side the one glued to it
  std::vector<uint32_t> quads;
  /// For each patch the corner of its quad that is the north-west corner of the patch. The corners
  /// of a patch go clockwise from there, which is against the order of those of the quad.
  std::vector<uint8_t> first_corners;

  /// The corner of its quad that is corner `corner` of a patch: 0 is the north-west corner, 1 the
  /// north-east, 2 the south-east, 3 the south-west one.
  uint32_t quadCorner(uint32_t patch, uint32_t corner) const {
    return (first_corners[patch] + 4 - corner) % 4;
  }
};

/// An edge that more than two quads have is a border of all of them.
QuadForest quadForest(std::span<const Quad> quads);

}  // namespace tetrakis::inline remesh
