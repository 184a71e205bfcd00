// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/screen_mesh.hpp"

#include <utility>
#include <vector>

#include "codec/mesh/fitting/height_range.hpp"
#include "codec/mesh/needless_vertices.hpp"
#include "codec/mesh/turned_edges.hpp"
#include "codec/mesh/void_mesh.hpp"

namespace tetrakis::inline mesh {
namespace {

Result<FittedMesh> latticeMesh(const Lattice& lattice, const WeightedSurface& surface,
                               uint32_t max_triangles,
                               const std::function<Status(uint64_t)>& admits) {
  if (!surface.known.empty()) {
    Result<FittedVertices> beside = verticesBesideVoids(lattice, surface, max_triangles, admits);
    if (!beside.ok()) return beside.status();
    return FittedMesh{meshOf(lattice, beside->vertices), std::move(beside->heights)};
  }
  const Result<FittedSequence> sequence = FittedSequence::makeFor(surface, max_triangles);
  if (!sequence.ok()) return sequence.status();
  std::vector<VertexId> vertices = sequence->order();
  vertices.resize(sequence->longestPrefix(max_triangles));
  return fitMesh(lattice, surface, withoutNeedless(lattice, surface.view, std::move(vertices)));
}

}  // namespace

Result<FittedMesh> screenMesh(const Lattice& lattice, const WeightedSurface& surface,
                              uint32_t max_triangles,
                              const std::function<Status(uint64_t)>& admits) {
  Result<FittedMesh> mesh = latticeMesh(lattice, surface, max_triangles, admits);
  if (!mesh.ok()) return mesh;
  FittedMesh turned = withTurnedEdges(surface, std::move(*mesh));
  return FittedMesh{std::move(turned.mesh), withinRange(surface, std::move(turned.heights))};
}

}  // namespace tetrakis::inline mesh
