// SPDX-License-Identifier: Apache-2.0
// surfaceMesh() makes meshes of the decoded surface, in the form that the C interface and the mesh
// tree take.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline api {

/// inserted: the closed set of lattice vertices that `mesh` is made of. heights: in the unit, one
/// for each vertex of `mesh`; NaN where it is void (codec/mesh/void_mesh.hpp).
struct SurfaceMesh {
  Lattice lattice;
  std::vector<VertexId> inserted;
  LatticeMesh mesh;
  std::vector<float> heights;
};

/// What tks_decode_mesh promises. TKS_USAGE for an unknown kind or a stream without heights, and
/// the errors of Lattice::make.
Result<SurfaceMesh> surfaceMesh(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles);

/// Heights of the vertices in the unit, NaN where they are void. valid: of all samples.
/// steps_of(vertex): its height in the decoder's steps.
template <class StepsOf>
std::vector<float> heightsInUnit(const LatticeMesh& mesh, Mask valid, const SurfaceScale& scale,
                                 const StepsOf& steps_of) {
  std::vector<float> heights;
  heights.reserve(mesh.vertices.size());
  for (size_t v = 0; v < mesh.vertices.size(); ++v)
    heights.push_back(valid[mesh.vertices[v]]
                          ? static_cast<float>(steps_of(v) * scale.scale + scale.offset)
                          : std::numeric_limits<float>::quiet_NaN());
  return heights;
}

/// Copies into arrays that tks_free_mesh releases. Throws std::bad_alloc; `out` can then be freed.
void copyMesh(const LatticeMesh& mesh, std::span<const float> heights, tks_mesh& out);

}  // namespace tetrakis::inline api
