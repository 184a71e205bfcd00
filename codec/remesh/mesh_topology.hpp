// SPDX-License-Identifier: Apache-2.0
// topologyOf() counts what does not change if a surface is bent: its components, its boundaries and
// its Euler number. So it shows whether a step of the encoder has torn or closed the surface.
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

/// `mesh` is an oriented manifold, perhaps with boundary, such as `cleaned()` returns. Points that
/// no triangle has do not count.
Topology topologyOf(const TriangleMesh& mesh);

}  // namespace tetrakis::inline remesh
