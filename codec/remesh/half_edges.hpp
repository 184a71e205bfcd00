// SPDX-License-Identifier: Apache-2.0
// Half-edges, which are the sides of triangles: side k of a triangle runs from its corner k to the
// next one, and has the number 3 * triangle + k. The corner that it starts from has that number
// too.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

inline uint32_t nextSide(uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
inline uint32_t previousSide(uint32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}
/// The point that a half-edge starts from.
inline uint32_t startOf(std::span<const Triangle> triangles, uint32_t side) {
  return triangles[side / 3][side % 3];
}

struct GluedSides {
  std::vector<uint32_t> opposite;  ///< for each half-edge the one that it is glued to, or kNone
  uint32_t edges = 0;              ///< number of different pairs of ends
  uint32_t crowded = 0;            ///< edges of three or more half-edges, which have no opposite
};

/// Two half-edges are glued if they have the same ends, whichever their directions, and no third
/// one has these ends.
GluedSides gluedSides(std::span<const Triangle> triangles);

}  // namespace tetrakis::inline remesh
