// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/mesh_topology.hpp"

#include <vector>

#include "codec/remesh/disjoint_sets.hpp"
#include "codec/remesh/half_edges.hpp"

namespace tetrakis::inline remesh {
namespace {

/// The number of sets that hold at least one of these points. (If a set holds one, it holds its
/// lowest one too.)
uint32_t setsOf(DisjointSets& sets, const std::vector<bool>& points) {
  uint32_t count = 0;
  for (uint32_t point = 0; point < points.size(); ++point)
    count += points[point] && sets.find(point) == point;
  return count;
}

}  // namespace

Topology topologyOf(const TriangleMesh& mesh) {
  const GluedSides glued = gluedSides(mesh.triangles);
  const size_t points = mesh.points.size();
  DisjointSets components(points), loops(points);
  std::vector<bool> used(points), on_boundary(points);
  int64_t euler = static_cast<int64_t>(mesh.triangles.size()) - glued.edges;
  for (uint32_t side = 0; side < glued.opposite.size(); ++side) {
    const uint32_t start = startOf(mesh.triangles, side);
    const uint32_t end = startOf(mesh.triangles, nextSide(side));
    euler += !used[start];
    used[start] = true;
    components.join(start, end);
    if (glued.opposite[side] != kNone) continue;
    on_boundary[start] = on_boundary[end] = true;
    loops.join(start, end);
  }
  return {setsOf(components, used), setsOf(loops, on_boundary), euler};
}

}  // namespace tetrakis::inline remesh
