// SPDX-License-Identifier: Apache-2.0
// The calls of the C interface that make meshes of the decoded surface, and those that keep a mesh
// for many views.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "api/guarded.hpp"
#include "api/memory.hpp"
#include "api/written.hpp"
#include "base/forest.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "codec/mesh/forest/forest_lattice.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/meshes.hpp"
#include "codec/mesh/quadtree/mesh_tree.hpp"

// Meshes kept for many views, through the C interface.

struct tks_mesh_tree {
  tetrakis::MeshTree tree;
  tetrakis::MapBox box;
};

namespace tetrakis::inline api {

namespace {

Status decodeTree(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                  tks_mesh_tree*& out) {
  const Result<SurfaceMesh> surface = surfaceMesh(decoder, kind, max_triangles);
  if (!surface.ok()) return surface.status();
  out = new tks_mesh_tree{
      MeshTree(surface->lattice, surface->inserted, surface->heights),
      MapBox::around(surface->lattice.width(), surface->lattice.height(), surface->heights)};
  return {};
}

Status viewMesh(const tks_mesh_tree& tree, const double* clip, tks_mesh& out) {
  std::array<double, 16> matrix;
  std::copy_n(clip, matrix.size(), matrix.begin());
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(matrix.begin(), matrix.end(), finite))
    return {TKS_USAGE, "The matrix of a view must be finite."};
  ViewMesh view = tree.tree.view(viewFootprint(matrix, tree.box));
  leaveOutVoids(view.mesh, view.heights);
  copyMesh(view.mesh, view.heights, out);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_decode_mesh_tree(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                                tks_mesh_tree** out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = nullptr;
  return tetrakis::keeping(
      decoder, [&] { return tetrakis::decodeTree(*decoder, kind, max_triangles, *out); });
}

tks_status tks_view_mesh(const tks_mesh_tree* tree, const double clip[16], tks_mesh* out) {
  if (tree == nullptr || clip == nullptr || out == nullptr) return TKS_USAGE;
  *out = {};
  const tks_status status =
      tetrakis::answering([&] { return tetrakis::viewMesh(*tree, clip, *out); });
  if (status != TKS_OK) tks_free_mesh(out);
  return status;
}

void tks_free_mesh_tree(tks_mesh_tree* tree) {
  delete tree;
}

namespace tetrakis::inline api {

// Meshes of the decoded surface through the C interface.

namespace {

/// Vertices of a mesh but the roots, and its heights in the decoder's steps if they are fitted.
struct Chosen {
  std::vector<VertexId> vertices;
  std::vector<double> fitted;  ///< one for each vertex of the mesh; empty: those of the samples
};

Result<Chosen> chosenVertices(const tks_decoder& decoder, const Lattice& lattice,
                              const DecodedGeometry& geometry, tks_mesh_kind kind,
                              uint32_t max_triangles) {
  if (kind == TKS_MESH_CODED) return Chosen{codedVertices(lattice, geometry.significant), {}};
  if (max_triangles == 0) return Chosen{allVertices(lattice), {}};
  const auto admits = [&](uint64_t triangles) -> Status {
    if (triangles <= max_triangles) return {};
    return checkBytes(decoder, {TKS_PART_BUDGET_MESH, {}, max_triangles},
                      voidMeshBytes(lattice, triangles));
  };
  const WeightedSurface surface{{lattice.width(), lattice.height(), geometry.heights},
                                geometry.valid};
  Result<FittedVertices> beside = verticesBesideVoids(lattice, surface, max_triangles, admits);
  if (!beside.ok()) return beside.status();
  return Chosen{std::move(beside->vertices), std::move(beside->heights)};
}

/// Mip level `level` of the heights, in steps of the decoder, and their scale.
struct DecodedLevel {
  KnownSurface known;
  SurfaceScale scale;
};

Result<DecodedLevel> decodedLevel(tks_decoder& decoder, uint32_t level) {
  const StreamHeader& header = decoder.parsed.header;
  const GeometryHeader& g = *header.geometry;
  DecodedHeights coarse;
  const DecodedGeometry* geometry = nullptr;
  if (level == 0) {
    const Result<const DecodedGeometry*> whole = decodedGeometry(decoder);
    if (!whole.ok()) return whole.status();
    geometry = *whole;
  } else {
    // No higher than the coarsest: 2^level is less than a quarter of the longer side.
    coarse = decodeHeights(decoder, {static_cast<int>(level), {}});
    geometry = &coarse.geometry;
  }
  return DecodedLevel{{ofMipLevel(geometry->heights, g.shown().width, g.shown().height, level),
                       level, level + geometry->quiet_levels},
                      surfaceScale(header, *geometry)};
}

Result<SurfaceMesh> budgetMeshOf(tks_decoder& decoder, Lattice lattice, uint32_t max_triangles,
                                 std::span<const float> row_weights) {
  Result<DecodedLevel> level = decodedLevel(decoder, budgetMeshLevel(lattice, max_triangles));
  if (!level.ok()) return level.status();
  level->known.row_weights = row_weights;
  Result<BudgetMesh> mesh = budgetMesh(lattice, std::move(level->known), max_triangles);
  if (!mesh.ok()) return mesh.status();
  std::vector<float> heights =
      heightsInUnit(mesh->mesh, {}, level->scale, [&](size_t v) { return mesh->heights[v]; });
  return SurfaceMesh{std::move(lattice), std::move(mesh->vertices), std::move(mesh->mesh),
                     std::move(heights)};
}

Status notOfLevel() {
  return {TKS_USAGE, "Meshes are made of the heights of level 0; ask for few triangles."};
}

/// Of vertices that are samples.
std::vector<float> surfaceAtVertices(const tks_decoder& decoder, const DecodedHeights& decoded,
                                     const LatticeMesh& mesh) {
  std::vector<float> surface(decoded.geometry.heights.size());
  writeSurface(decoder, decoded, surface.data());
  std::vector<float> heights;
  heights.reserve(mesh.vertices.size());
  for (const VertexId vertex : mesh.vertices) heights.push_back(surface[vertex]);
  return heights;
}

}  // namespace

Result<SurfaceMesh> surfaceMesh(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                                std::span<const float> row_weights) {
  if (kind != TKS_MESH_CODED && kind != TKS_MESH_BUDGET)
    return Status(TKS_USAGE, "Unknown kind of mesh.");
  if (decoder.heights_level > 0) return notOfLevel();
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return noHeights();
  if (header.geometry->wavelet.forest != nullptr) return noMesh();
  Result<Lattice> lattice =
      Lattice::make(header.geometry->shown().width, header.geometry->shown().height);
  if (!lattice.ok()) return lattice.status();
  const tks_part part = kind == TKS_MESH_CODED ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH;
  if (Status s = checkMemory(decoder, {part, {}, max_triangles}); !s.ok()) return s;
  const bool has_voids = header.layers.validity_bytes > 0;
  if (kind == TKS_MESH_BUDGET && max_triangles > 0 && !has_voids)
    return budgetMeshOf(decoder, std::move(*lattice), max_triangles, row_weights);
  const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
  if (!decoded.ok()) return decoded.status();
  const DecodedGeometry& geometry = (*decoded)->geometry;
  Result<Chosen> chosen = chosenVertices(decoder, *lattice, geometry, kind, max_triangles);
  if (!chosen.ok()) return chosen.status();
  LatticeMesh mesh = meshOf(*lattice, chosen->vertices);
  std::vector<float> heights =
      chosen->fitted.empty() ? surfaceAtVertices(decoder, **decoded, mesh)
                             : heightsInUnit(mesh, geometry.valid, surfaceScale(header, geometry),
                                             [&](size_t v) { return chosen->fitted[v]; });
  return SurfaceMesh{std::move(*lattice), std::move(chosen->vertices), std::move(mesh),
                     std::move(heights)};
}

void copyMesh(const LatticeMesh& mesh, std::span<const float> heights, tks_mesh& out) {
  const auto copy = [](auto& values, auto*& to) {
    to = allocate<std::remove_cvref_t<decltype(values[0])>>(values.size());
    std::copy(values.begin(), values.end(), to);
  };
  out.vertex_count = static_cast<uint32_t>(mesh.vertices.size());
  out.triangle_count = static_cast<uint32_t>(mesh.triangleCount());
  copy(mesh.vertices, out.grid_index);
  copy(heights, out.height);
  copy(mesh.triangles, out.triangles);
}

/// The vertices of a mesh of heights on a forest.
std::vector<ForestVertex> chosenVertices(const ForestLattice& lattice,
                                         const DecodedGeometry& geometry,
                                         const ForestMeshing& meshing, Coordinates coordinates) {
  if (meshing.kind == TKS_MESH_CODED) return closureOfMarks(lattice, geometry.significant);
  if (meshing.max_triangles > 0)
    return forestBudgetVertices(lattice, coordinates, meshing.max_triangles);
  std::vector<ForestVertex> all(lattice.vertexCount());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

namespace {

/// These vertices, and all vertices with numbers below `first`.
std::vector<ForestVertex> withAllBefore(ForestVertex first, std::vector<ForestVertex> vertices) {
  std::erase_if(vertices, [&](ForestVertex v) { return v < first; });
  const size_t chosen = vertices.size();
  vertices.resize(chosen + first);
  std::iota(vertices.begin() + static_cast<std::ptrdiff_t>(chosen), vertices.end(), 0u);
  return vertices;
}

}  // namespace

namespace {

Status checkMeshing(tks_decoder& decoder, const ForestMeshing& meshing, uint64_t beside) {
  if (decoder.heights_level > 0) return notOfLevel();
  const bool coded = meshing.kind == TKS_MESH_CODED;
  if (!coded && meshing.kind != TKS_MESH_BUDGET) return Status(TKS_USAGE, "Unknown kind of mesh.");
  const tks_part part = coded ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH;
  return checkMemory(decoder, {part, {}, meshing.max_triangles}, beside);
}

}  // namespace

Result<const DecodedHeights*> heightsForMesh(tks_decoder& decoder, const ForestMeshing& meshing,
                                             uint64_t beside) {
  if (Status status = checkMeshing(decoder, meshing, beside); !status.ok()) return status;
  return decodedHeights(decoder);
}

namespace {

/// The weights of the samples of a patch: on a globe the area that they cover.
std::vector<float> patchWeights(const tks_decoder& decoder, const Forest& forest) {
  const bool is_cube = std::equal(forest.sides().begin(), forest.sides().end(), kCubeSides.begin(),
                                  kCubeSides.end());
  return is_cube && !decoder.base_mesh ? patchAreas(forest.side()) : std::vector<float>();
}

/// The sample of the raster that a sample of a level lies on.
uint32_t rasterSample(const Forest& forest, int level, uint32_t sample) {
  const uint32_t side = (forest.side() - 1) / (uint32_t{1} << level) + 1;
  const View view{level, {}, 0, forest.side()};
  return view.rowOf(sample / side) * forest.side() + (sample % side << level);
}

/// A mesh within a budget, of the mip level that so few triangles can show, whose heights are
/// fitted.
Result<ForestSurface> fittedSurface(tks_decoder& decoder, const ForestMeshing& meshing) {
  const StreamHeader& header = decoder.parsed.header;
  const Forest& forest = *header.geometry->wavelet.forest;
  const int level = spareLevels(forest, meshing.max_triangles);
  DecodedHeights coarse;
  if (level > 0) coarse = decodeHeights(decoder, levelOf(*header.geometry, level));
  const Result<const DecodedHeights*> whole = level > 0 ? &coarse : decodedHeights(decoder);
  if (!whole.ok()) return whole.status();
  const DecodedGeometry& geometry = (*whole)->geometry;
  const Forest of_level(forest.depth() - level, forest.sides());
  const ForestLattice lattice(of_level);
  const std::vector<float> weights = patchWeights(decoder, of_level);
  const std::span<const int32_t> heights = geometry.heights;
  const std::vector<ForestVertex> vertices =
      withAllBefore(lattice.firstOf(meshing.first_chosen_level),
                    forestBudgetVertices(lattice, heights, meshing.max_triangles, weights));
  ForestSurface surface{meshing.apart ? patchesOf(lattice, vertices) : meshOf(lattice, vertices),
                        {}};
  const std::vector<double> fitted =
      fittedHeights(lattice, heights, geometry.valid, vertices, weights);
  surface.heights = heightsInUnit(surface.mesh, geometry.valid, surfaceScale(header, geometry),
                                  [&](size_t v) { return fitted[surface.mesh.vertices[v]]; });
  for (uint32_t& sample : surface.mesh.vertices) sample = rasterSample(forest, level, sample);
  leaveOutVoids(surface.mesh, surface.heights);
  return surface;
}

}  // namespace

Result<ForestSurface> forestSurface(tks_decoder& decoder, const ForestMeshing& meshing,
                                    uint64_t beside) {
  if (Status status = checkMeshing(decoder, meshing, beside); !status.ok()) return status;
  if (meshing.kind == TKS_MESH_BUDGET && meshing.max_triangles > 0)
    return fittedSurface(decoder, meshing);
  const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
  if (!decoded.ok()) return decoded.status();
  const ForestLattice lattice(*decoder.parsed.header.geometry->wavelet.forest);
  const std::span<const int32_t> heights = (*decoded)->geometry.heights;
  const std::vector<ForestVertex> vertices =
      withAllBefore(lattice.firstOf(meshing.first_chosen_level),
                    chosenVertices(lattice, (*decoded)->geometry, meshing, {&heights, 1}));
  ForestSurface surface{meshing.apart ? patchesOf(lattice, vertices) : meshOf(lattice, vertices),
                        {}};
  surface.heights = surfaceAtVertices(decoder, **decoded, surface.mesh);
  leaveOutVoids(surface.mesh, surface.heights);
  return surface;
}

namespace {

Status decodeMesh(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles, tks_mesh& out) {
  const auto& geometry = decoder.parsed.header.geometry;
  if (geometry && geometry->wavelet.forest != nullptr) {
    const Result<ForestSurface> surface = forestSurface(decoder, {kind, max_triangles});
    if (surface.ok()) copyMesh(surface->mesh, surface->heights, out);
    return surface.ok() ? Status() : surface.status();
  }
  Result<SurfaceMesh> surface = surfaceMesh(decoder, kind, max_triangles);
  if (!surface.ok()) return surface.status();
  leaveOutVoids(surface->mesh, surface->heights);
  copyMesh(surface->mesh, surface->heights, out);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_decode_mesh(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                           tks_mesh* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = {};
  const tks_status status = tetrakis::keeping(
      decoder, [&] { return tetrakis::decodeMesh(*decoder, kind, max_triangles, *out); });
  if (status != TKS_OK) tks_free_mesh(out);
  return status;
}

void tks_free_mesh(tks_mesh* mesh) {
  if (mesh == nullptr) return;
  std::free(mesh->grid_index);
  std::free(mesh->height);
  std::free(mesh->triangles);
  *mesh = {};
}
