// SPDX-License-Identifier: Apache-2.0
// Meshes of the decoded surface through the C interface.
#include <cstdlib>
#include <cstring>

#include "api/decoder.hpp"
#include "api/message.hpp"
#include "codec/decimation.hpp"
#include "codec/lattice_mesh.hpp"

namespace tetrakis {

namespace {

Result<LatticeMesh> makeMesh(const DecodedGeometry& geometry, const GeometryHeader& header,
                             tks_mesh_kind kind, uint32_t max_triangles) {
  Result<Lattice> lattice = Lattice::make(header.width, header.height);
  if (!lattice.ok()) return lattice.status();
  if (kind == TKS_MESH_CODED) return codedMesh(*lattice, geometry.significant);
  if (max_triangles == 0) return fullMesh(*lattice);
  Result<MeshSequence> sequence = decimate({header.width, header.height, geometry.heights});
  if (!sequence.ok()) return sequence.status();
  return sequence->meshWithAtMost(max_triangles);
}

template <class T>
T* allocate(size_t count) {
  void* memory = std::malloc(count * sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
  return static_cast<T*>(memory);
}

Status decodeMesh(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles, tks_mesh& out) {
  if (kind != TKS_MESH_CODED && kind != TKS_MESH_BUDGET)
    return {TKS_USAGE, "Unknown kind of mesh."};
  Result<const DecodedGeometry*> geometry = decodedGeometry(decoder);
  if (!geometry.ok()) return geometry.status();
  const StreamHeader& header = decoder.parsed.header;
  Result<LatticeMesh> mesh = makeMesh(**geometry, *header.geometry, kind, max_triangles);
  if (!mesh.ok()) return mesh.status();
  out.vertex_count = static_cast<uint32_t>(mesh->vertices.size());
  out.triangle_count = static_cast<uint32_t>(mesh->triangleCount());
  out.grid_index = allocate<uint32_t>(mesh->vertices.size());
  out.height = allocate<float>(mesh->vertices.size());
  out.triangles = allocate<uint32_t>(mesh->triangles.size());
  std::memcpy(out.grid_index, mesh->vertices.data(), mesh->vertices.size() * sizeof(uint32_t));
  std::memcpy(out.triangles, mesh->triangles.data(), mesh->triangles.size() * sizeof(uint32_t));
  const SurfaceScale scale = surfaceScale(header);
  for (size_t i = 0; i < mesh->vertices.size(); ++i) {
    out.height[i] =
        static_cast<float>((*geometry)->heights[mesh->vertices[i]] * scale.scale + scale.offset);
  }
  return {};
}

}  // namespace

}  // namespace tetrakis

tks_status tks_decode_mesh(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                           tks_mesh* out) {
  if (decoder == nullptr || out == nullptr) return TKS_USAGE;
  *out = {};
  const tetrakis::Status status =
      tetrakis::guarded([&] { return tetrakis::decodeMesh(*decoder, kind, max_triangles, *out); });
  if (!status.ok()) tks_free_mesh(out);
  decoder->message = status.message();
  return status.code();
}

void tks_free_mesh(tks_mesh* mesh) {
  if (mesh == nullptr) return;
  std::free(mesh->grid_index);
  std::free(mesh->height);
  std::free(mesh->triangles);
  *mesh = {};
}
