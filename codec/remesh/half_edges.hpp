// SPDX-License-Identifier: Apache-2.0
// Half-edges: side k of a triangle runs from its corner k to the next one, and has the number
// 3 * triangle + k. It is also the name of the corner that it starts from.
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
inline uint32_t startOf(std::span<const Triangle> triangles, uint32_t side) {
  return triangles[side / 3][side % 3];
}

struct GluedSides {
  std::vector<uint32_t> opposite;  ///< for each half-edge the other one of its edge, or kNone
  uint32_t edges = 0;
  uint32_t crowded = 0;  ///< edges of three or more triangles; their half-edges have no opposite
};

/// Two half-edges are glued if they have the same ends, in whatever directions.
GluedSides gluedSides(std::span<const Triangle> triangles);

}  // namespace tetrakis::inline remesh
