// SPDX-License-Identifier: Apache-2.0
// blob(), knot() and scan() make meshes that have no texture yet.
#pragma once

#include <cstdint>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::tools::synth {

using Spot = tetrakis::Point;  ///< a place or a direction in space; Point is one on the ground

/// The direction of a vector, of length 1. It is (1, 0, 0) where there is none.
inline Spot directionOf(const Spot& a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : Spot{1, 0, 0};
}

/// Each has about so many triangles, and is about two units across.
TriangleMesh blob(uint32_t triangles, uint64_t seed);
TriangleMesh knot(uint32_t triangles, uint64_t seed);
TriangleMesh scan(uint32_t triangles, uint64_t seed);

}  // namespace tetrakis::tools::synth
