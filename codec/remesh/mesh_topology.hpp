// SPDX-License-Identifier: Apache-2.0
// The numbers that say of what shape a surface is, however it is bent: they tell whether a step of
// the encoder has torn or closed anything.
#pragma once

#include <cstdint>

#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

struct Topology {
  uint32_t components = 0;
  uint32_t boundary_loops = 0;
  int64_t euler = 0;  ///< points − edges + triangles; 2 for a sphere, 0 for a torus, 1 for a disc

  bool operator==(const Topology&) const = default;
};

/// `mesh`: an oriented manifold, perhaps with boundary, as `cleaned()` returns. Points of no
/// triangle do not count.
Topology topologyOf(const TriangleMesh& mesh);

}  // namespace tetrakis::inline remesh
