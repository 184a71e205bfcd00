// SPDX-License-Identifier: Apache-2.0
// Meshes of objects through the C interface: of heights along the normals of a base mesh, and of
// triangles that are coded as they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "api/collapsed_object.hpp"
#include "api/guarded.hpp"
#include "api/memory.hpp"
#include "api/triangle_object.hpp"
#include "api/written.hpp"
#include "codec/basemesh/base_mesh.hpp"
#include "codec/basemesh/bent_base.hpp"
#include "codec/mesh/forest/glued_triangles.hpp"
#include "codec/mesh/forest/object_gains.hpp"
#include "codec/mesh/meshes.hpp"

namespace tetrakis::inline api {
namespace {

/// Where the samples of the raster lie, once as numbers and once in units of a place of the base,
/// by which vertices are chosen.
struct ObjectPlaces {
  std::vector<std::array<double, 3>> places;
  ObjectRasters units;
};

bool hasBudget(const ForestMeshing& meshing) {
  return meshing.kind == TKS_MESH_BUDGET && meshing.max_triangles > 0;
}

ObjectPlaces placesOf(const BaseMesh& mesh, std::span<const float> heights) {
  const BentBase base(mesh);
  const double unit = mesh.cell / (1 << BentBase::kPlaceBits);
  ObjectPlaces all;
  all.places.reserve(heights.size());
  for (std::vector<int32_t>& units : all.units) units.reserve(heights.size());
  const auto unitsOf = [&](double from_origin) {
    constexpr double kMost = 1 << 30;
    const double units = from_origin / unit;  // of any size, and none where a cell is next to 0
    if (std::isnan(units)) return int32_t{0};
    return static_cast<int32_t>(std::floor(std::clamp(units, -kMost, kMost) + 0.5));
  };
  for (uint32_t patch = 0; patch < mesh.forest->patches(); ++patch) {
    for (const BasePoint& point : base.patch(patch)) {
      const float height = heights[all.places.size()];
      const auto place = placeOf(mesh, point, std::isnan(height) ? 0 : double{height});
      for (size_t axis = 0; axis < 3; ++axis)
        all.units[axis].push_back(unitsOf(place[axis] - mesh.origin[axis]));
      all.places.push_back(place);
    }
  }
  return all;
}

std::vector<ForestVertex> joined(const ForestLattice& lattice, std::span<const ForestVertex> a,
                                 std::span<const ForestVertex> b) {
  std::vector<uint8_t> in(lattice.vertexCount());
  for (const ForestVertex v : a) in[v] = 1;
  for (const ForestVertex v : b) in[v] = 1;
  std::vector<ForestVertex> both;
  for (ForestVertex v = 0; v < in.size(); ++v)
    if (in[v] != 0) both.push_back(v);
  return both;
}

uint64_t trianglesOf(const ForestLattice& lattice, std::span<const ForestVertex> vertices) {
  const ClosureGraph graph = lattice.graph();
  uint64_t triangles = lattice.baseTriangles();
  for (const ForestVertex v : vertices) triangles += graph.costs[v];
  return triangles;
}

/// The closed set of a mesh without double edges, of at most max_triangles triangles unless those
/// of the base, and `needed` beside them, are more.
std::vector<ForestVertex> chosenPlaces(const ForestLattice& lattice,
                                       const DecodedGeometry& geometry, uint32_t max_triangles,
                                       const ObjectPlaces& all) {
  const auto rasters = coordinatesOfErrors(lattice.forest(), all.units);
  const std::vector<std::span<const int32_t>> coordinates(rasters.begin(), rasters.end());
  const std::vector<ForestVertex> needed = singleEdges(lattice);
  const auto within = [&](uint64_t most) {
    const ForestMeshing meshing{TKS_MESH_BUDGET, static_cast<uint32_t>(most)};
    return joined(lattice, chosenVertices(lattice, geometry, meshing, coordinates), needed);
  };
  std::vector<ForestVertex> vertices = within(max_triangles);
  if (needed.empty() || trianglesOf(lattice, vertices) <= max_triangles) return vertices;
  const uint64_t spare = trianglesOf(lattice, needed) - lattice.baseTriangles();
  return max_triangles > spare ? within(max_triangles - spare) : needed;
}

std::vector<uint8_t> knownOf(std::span<const float> heights) {
  std::vector<uint8_t> known;
  for (const float height : heights) known.push_back(std::isnan(height) ? 0 : 1);
  return known;
}

/// Moves the vertices of a mesh to where their triangles come nearest to all samples, which takes
/// coordinate by coordinate what fitted heights take (codec/mesh/forest/forest_mesh.hpp).
void fitPlaces(const ForestLattice& lattice, std::span<const float> heights, double unit,
               std::span<const ForestVertex> vertices, ObjectPlaces& all) {
  const std::vector<uint8_t> known = knownOf(heights);
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<int32_t>& units = all.units[axis];
    const std::vector<double> fitted = fittedHeights(lattice, units, known, vertices);
    for (size_t sample = 0; sample < fitted.size(); ++sample)
      all.places[sample][axis] += (fitted[sample] - units[sample]) * unit;
  }
}

/// Where a sample of the heights lies on the texture: in the middle of a texel of its raster.
void fillTexcoords(const Forest& forest, const Forest& texels,
                   const std::vector<uint32_t>& vertices, double* out) {
  const auto [width, height] = texels.raster();
  const double scale = std::ldexp(1.0, texels.depth() - forest.depth());
  for (const uint32_t sample : vertices) {
    const uint32_t row = sample / forest.side(), patch = row / forest.side();
    const double x = scale * (sample % forest.side()), y = scale * (row % forest.side());
    *out++ = (x + 0.5) / width;
    *out++ = (static_cast<double>(size_t{texels.side()} * patch) + y + 0.5) / height;
  }
}

void copyObject(const Forest& forest, const ObjectVertices& mesh, std::span<const float> heights,
                const ObjectPlaces& places, tks_object_mesh& out) {
  out.vertex_count = static_cast<uint32_t>(mesh.places.size());
  out.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  out.position = allocate<double>(3 * mesh.places.size());
  out.pixel = allocate<double>(2 * mesh.places.size());
  out.height = allocate<float>(mesh.places.size());
  out.triangles = allocate<uint32_t>(mesh.triangles.size());
  for (size_t v = 0; v < mesh.places.size(); ++v) {
    std::copy_n(places.places[mesh.places[v]].begin(), 3, out.position + 3 * v);
    out.height[v] = heights[mesh.places[v]];
    out.pixel[2 * v] = mesh.texels[v] % forest.side() + 0.5;
    out.pixel[2 * v + 1] = static_cast<double>(mesh.texels[v] / forest.side()) + 0.5;
  }
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), out.triangles);
}

/// All of the vertices, where no budget is too small for them.
ObjectVertices wholeMesh(const ForestLattice& lattice, std::span<const ForestVertex> vertices,
                         std::span<const float> heights, bool apart) {
  LatticeMesh mesh = apart ? patchesOf(lattice, vertices) : meshOf(lattice, vertices);
  std::vector<float> of_vertices;
  for (const uint32_t sample : mesh.vertices) of_vertices.push_back(heights[sample]);
  leaveOutVoids(mesh, of_vertices);
  return {mesh.vertices, mesh.vertices, std::move(mesh.triangles)};
}

/// Moves places.
ObjectVertices budgetMesh(const ForestLattice& lattice, const DecodedGeometry& geometry,
                          std::span<const float> heights, const ForestMeshing& meshing, double unit,
                          ObjectPlaces& places) {
  std::vector<ForestVertex> vertices =
      chosenPlaces(lattice, geometry, meshing.max_triangles, places);
  const bool is_few = trianglesOf(lattice, vertices) > meshing.max_triangles;
  if (is_few) {
    const uint32_t base = lattice.baseTriangles();
    const bool is_fine = uint64_t{kMostFromBase} * meshing.max_triangles > base;
    vertices = chosenPlaces(lattice, geometry, is_fine ? 2 * base : base, places);
  }
  if (vertices.size() < lattice.vertexCount()) fitPlaces(lattice, heights, unit, vertices, places);
  if (!is_few) return wholeMesh(lattice, vertices, heights, meshing.apart);
  return collapsedObject(gluedTriangles(lattice, vertices, knownOf(heights)), places.places,
                         meshing.max_triangles, meshing.apart);
}

Status decodeObject(tks_decoder& decoder, const ForestMeshing& meshing, tks_object_mesh& out) {
  const StreamHeader& header = decoder.parsed.header;
  if (!decoder.base_mesh)
    return {TKS_USAGE, "The stream is no object: its heights, if it has any, have no base mesh."};
  constexpr uint64_t kSample = 100, kPatch = 1600;
  const BaseMesh& base = *decoder.base_mesh;
  const Result<const DecodedHeights*> decoded =
      heightsForMesh(decoder, meshing,
                     kSample * base.forest->raster().samples() + kPatch * base.forest->patches());
  if (!decoded.ok()) return decoded.status();
  const DecodedGeometry& geometry = (*decoded)->geometry;
  std::vector<float> heights(base.forest->raster().samples());
  writeSurface(decoder, **decoded, heights.data());
  ObjectPlaces places = placesOf(base, heights);
  const ForestLattice lattice(*base.forest);
  const ObjectVertices mesh =
      hasBudget(meshing) ? budgetMesh(lattice, geometry, heights, meshing,
                                      base.cell / (1 << BentBase::kPlaceBits), places)
                         : wholeMesh(lattice, chosenVertices(lattice, geometry, meshing, {}),
                                     heights, meshing.apart);
  copyObject(*base.forest, mesh, heights, places, out);
  const auto& texture = header.texture;
  if (!texture || texture->wavelet.forest == nullptr) return {};
  out.texcoord = allocate<double>(2 * size_t{out.vertex_count});
  fillTexcoords(*base.forest, *texture->wavelet.forest, mesh.texels, out.texcoord);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_decode_object(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                             tks_object_mesh* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = {};
  const bool apart = decoder->parsed.header.texture.has_value();
  const tks_status status = tetrakis::keeping(decoder, [&] {
    return decoder->parsed.header.triangle_mesh.none()
               ? tetrakis::decodeObject(*decoder, {kind, max_triangles, 0, apart}, *out)
               : tetrakis::decodeTriangleObject(*decoder, kind, max_triangles, *out);
  });
  if (status != TKS_OK) tks_free_object_mesh(out);
  return status;
}

void tks_free_object_mesh(tks_object_mesh* mesh) {
  if (mesh == nullptr) return;
  std::free(mesh->position);
  std::free(mesh->pixel);
  std::free(mesh->texcoord);
  std::free(mesh->height);
  std::free(mesh->triangles);
  *mesh = {};
}
