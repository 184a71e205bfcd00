// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>

#include "base/forest.hpp"
#include "codec/mesh/forest/forest_mesh.hpp"
#include "codec/mesh/meshes.hpp"
#include "codec/mesh/screen/surface_picture.hpp"

namespace tetrakis::inline api {

namespace {

/// Of a mesh on a forest, whose vertices are fitted within a budget: of heights to a mip level, of
/// an object to every sample.
uint64_t forestBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  const GeometryHeader& geometry = *decoder.parsed.header.geometry;
  const Forest& forest = *geometry.wavelet.forest;
  const bool fitted = request.part == TKS_PART_BUDGET_MESH && request.max_triangles > 0;
  const int level = fitted && !decoder.base_mesh ? spareLevels(forest, request.max_triangles) : 0;
  const HeightsBytes heights(decoder, levelOf(geometry, level));
  const bool there = level == 0 && decoder.heights;
  const Forest of_level(forest.depth() - level, forest.sides());
  const uint64_t mesh = kOnceBytes + (fitted ? fittedMeshBytes(of_level, request.max_triangles)
                                             : forestMeshBytes(of_level));
  return there ? mesh : std::max(heights.decoding(), heights.kept() + mesh);
}

/// Samples, or vertices of the lattice, whichever are more.
uint64_t verticesOf(const Lattice& lattice) {
  return std::max<uint64_t>(lattice.sampleCount(), lattice.vertexCount());
}

}  // namespace

uint64_t meshBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  // Of a vertex and of a triangle.
  constexpr uint64_t kEverySample = 96;
  constexpr uint64_t kFitted = 26, kFewTriangles = 520, kManyTriangles = 180;
  const StreamHeader& header = decoder.parsed.header;
  const HeightsBytes heights(decoder, {});
  const uint64_t decoding = decoder.heights ? 0 : heights.decoding();
  const uint64_t kept = decoder.heights ? 0 : heights.kept();
  if (header.geometry->wavelet.forest != nullptr) return forestBytes(decoder, request);
  const Result<Lattice> lattice =
      Lattice::make(header.geometry->shown().width, header.geometry->shown().height);
  if (!lattice.ok()) return 0;  // refused for that
  const uint64_t samples = verticesOf(*lattice);
  const uint64_t base = uint64_t{2} * lattice->rootColumns() * lattice->rootRows();
  const uint64_t triangles =
      std::clamp<uint64_t>(request.max_triangles, base, std::max(base, 2 * samples));
  if (request.part == TKS_PART_CODED_MESH || request.max_triangles == 0)
    return std::max(decoding, kept + kOnceBytes + kEverySample * samples);
  if (header.layers.validity_bytes > 0)
    return std::max(decoding, kept + voidMeshBytes(*lattice, triangles));
  const uint32_t level = budgetMeshLevel(*lattice, request.max_triangles);
  const uint64_t fitted = (samples >> (2 * level)) + lattice->width() + lattice->height();
  const uint64_t few = std::min(triangles, fitted * 3 / 5);
  const uint64_t mesh =
      kOnceBytes + kFitted * fitted + kFewTriangles * few + kManyTriangles * (triangles - few);
  if (level == 0) return std::max(decoding, kept + mesh);
  const HeightsBytes coarse(decoder, {static_cast<int>(level), {}});
  return std::max(coarse.decoding(), coarse.kept() + mesh);
}

uint64_t voidMeshBytes(const Lattice& lattice, uint64_t triangles) {
  // Decimation of a plane whose slopes are equal, as those of an unknown surface: one bucket of its
  // queue and its first group hold all vertices. After it heights are fitted. How many samples are
  // valid is not known yet: of few, no level is left out (void_mesh.cpp).
  constexpr uint64_t kDecimated = 87;
  constexpr uint64_t kFitted = 32, kTriangle = 330;
  const uint64_t vertices = verticesOf(lattice);
  return kOnceBytes + std::max(kDecimated * vertices, kFitted * vertices + kTriangle * triangles);
}

uint64_t screenMeshBytes(const tks_decoder& decoder, const Lattice& lattice, uint64_t triangles,
                         uint64_t texels) {
  // Choosing and fitting among all samples, of a triangle at its most; then turning edges.
  constexpr uint64_t kFitted = 40, kFew = 560, kMany = 260;
  const uint64_t samples = verticesOf(lattice);
  const uint64_t base = uint64_t{2} * lattice.rootColumns() * lattice.rootRows();
  const uint64_t all = std::clamp<uint64_t>(triangles, base, std::max(base, 2 * samples));
  const uint64_t few = std::min(all, samples * 3 / 5);
  const HeightsBytes heights(decoder, {});
  const uint64_t decoding = decoder.heights ? 0 : heights.decoding();
  const uint64_t kept = decoder.heights ? 0 : heights.kept();
  const bool has_voids = decoder.parsed.header.layers.validity_bytes > 0;
  const uint64_t mesh = has_voids
                            ? voidMeshBytes(lattice, all)
                            : kOnceBytes + kFitted * samples + kFew * few + kMany * (all - few);
  const uint64_t turned = kFitted * samples + kMany * all;
  const uint64_t weights = screenWeightsBytes(samples) + 2 * texels;
  return std::max(decoding, kept + std::max(mesh, turned) + weights);
}

}  // namespace tetrakis::inline api
