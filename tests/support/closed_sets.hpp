// SPDX-License-Identifier: Apache-2.0
// Closed sets of vertices, which conforming meshes are made of (thesis 3.2.3).
#pragma once

#include <span>
#include <vector>

#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis {

/// Returns the smallest closed set that holds `vertices`: these vertices and their ancestors, in
/// the order of their ids.
inline std::vector<VertexId> closureOf(const Lattice& lattice, std::span<const VertexId> vertices) {
  std::vector<bool> marks(lattice.vertexCount());
  for (const VertexId v : vertices) marks[v] = true;
  for (VertexId v = lattice.vertexCount(); v-- > 0;) {
    if (!marks[v]) continue;
    lattice.forEachParent(lattice.site(v), [&](Site parent) { marks[lattice.id(parent)] = true; });
  }
  std::vector<VertexId> closed;
  for (VertexId v = 0; v < marks.size(); ++v)
    if (marks[v]) closed.push_back(v);
  return closed;
}

}  // namespace tetrakis
