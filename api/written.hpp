// SPDX-License-Identifier: Apache-2.0
// writeHeights(), writeTexels() and surfaceMesh() take what was decoded and write it in the form
// that callers of the C interface want: samples, texels, triangles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "base/samples.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline api {

// writeHeights() and its siblings write decoded heights and texels as the samples that the caller
// wants. A component without any byte is the same everywhere: one sample is decoded and copied, so
// that its planes take no memory.

/// out: as many samples of the stream's type, or floats, as there are decoded heights.
void writeHeights(const tks_decoder& decoder, const DecodedHeights& decoded, void* out);
void writeSurface(const tks_decoder& decoder, const DecodedHeights& decoded, float* out);

/// out: as many samples of that type as the texels have.
void writeTexels(const Texels& texels, tks_sample sample, void* out);

/// Write so many samples (heights, or texels) of a component of which nothing was sent.
void writeUnsentHeights(const tks_decoder& decoder, void* out, size_t count);
void writeUnsentSurface(const tks_decoder& decoder, float* out, size_t count);
void writeUnsentTexels(const TextureHeader& header, void* out, size_t count);

// surfaceMesh() makes meshes of the decoded surface, in the form that the C interface and the mesh
// tree take.

/// inserted: the closed set of lattice vertices that `mesh` is made of. heights: in the unit, one
/// for each vertex of `mesh`; NaN where it is void (codec/mesh/meshes.hpp).
struct SurfaceMesh {
  Lattice lattice;
  std::vector<VertexId> inserted;
  LatticeMesh mesh;
  std::vector<float> heights;
};

/// Writes the mesh that tks_decode_mesh promises. TKS_USAGE for an unknown kind or a stream without
/// heights, and the errors of Lattice::make. row_weights: of the squared errors of each row, where
/// a budget decides; empty: 1.
Result<SurfaceMesh> surfaceMesh(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                                std::span<const float> row_weights = {});

/// A mesh of heights on a forest: of all levels before one, and of the vertices that are chosen; of
/// patches that are joined, or apart (codec/mesh/forest/forest_lattice.hpp).
struct ForestSurface {
  LatticeMesh mesh;
  std::vector<float> heights;
};

struct ForestMeshing {
  tks_mesh_kind kind;
  uint32_t max_triangles;
  uint32_t first_chosen_level = 0;
  bool apart = false;
};

/// The heights of a mesh on a forest. TKS_USAGE: an unknown kind of mesh, or no heights. TKS_LIMIT
/// if the mesh and `beside` further bytes take more memory than the decoder may.
Result<const DecodedHeights*> heightsForMesh(tks_decoder& decoder, const ForestMeshing& meshing,
                                             uint64_t beside);

/// TKS_LIMIT if the mesh and `beside` further bytes take more memory than the decoder may.
Result<ForestSurface> forestSurface(tks_decoder& decoder, const ForestMeshing& meshing,
                                    uint64_t beside = 0);

/// The vertices of a mesh of heights on a forest, chosen by their coordinates.
std::vector<ForestVertex> chosenVertices(const ForestLattice& lattice,
                                         const DecodedGeometry& geometry,
                                         const ForestMeshing& meshing, Coordinates coordinates);

/// The float that is nearest to a height, and finite: what is decoded or fitted may lie beyond all
/// samples.
inline float finiteFloat(double height) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(height, -kMost, kMost));
}

/// Heights of the vertices in the unit, NaN where they are void. valid: of all samples.
/// steps_of(vertex): its height in the decoder's steps.
template <class StepsOf>
std::vector<float> heightsInUnit(const LatticeMesh& mesh, Mask valid, const SurfaceScale& scale,
                                 const StepsOf& steps_of) {
  std::vector<float> heights;
  heights.reserve(mesh.vertices.size());
  for (size_t v = 0; v < mesh.vertices.size(); ++v)
    heights.push_back(valid[mesh.vertices[v]]
                          ? finiteFloat(steps_of(v) * scale.scale + scale.offset)
                          : std::numeric_limits<float>::quiet_NaN());
  return heights;
}

/// An array that C callers release by std::free. Throws std::bad_alloc.
template <class T>
T* allocate(size_t count) {
  void* memory = std::malloc(count * sizeof(T));
  if (memory == nullptr && count > 0) throw std::bad_alloc();
  return static_cast<T*>(memory);
}

/// Copies into arrays that tks_free_mesh releases. Throws std::bad_alloc; `out` can then be freed.
void copyMesh(const LatticeMesh& mesh, std::span<const float> heights, tks_mesh& out);

}  // namespace tetrakis::inline api
