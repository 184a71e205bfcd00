// SPDX-License-Identifier: Apache-2.0
// Chosen on one level, fitted on the next finer one.
#include "api/budget_mesh.hpp"

#include <algorithm>

#include "codec/mesh/coarse_surface.hpp"
#include "codec/mesh/fitted_heights.hpp"

namespace tetrakis {

namespace {

constexpr uint64_t kPerTriangle = 5, kPerQuietTriangle = 1;

/// Finest levels that can be left out with so many samples left for each triangle.
uint32_t spareLevels(const Lattice& lattice, uint64_t per_triangle, uint32_t max_triangles) {
  const uint32_t shorter = std::min(lattice.width(), lattice.height()) - 1;
  const auto spare = [&](uint32_t levels) {
    return shorter >> levels > 0 &&
           lattice.sampleCount() >> (2 * levels) >= per_triangle * max_triangles;
  };
  uint32_t k = 0;
  while (spare(k + 1)) ++k;
  return k;
}

/// Every 2^level-th sample, in steps of the decoder.
struct KnownSurface {
  CoarseSurface surface;
  uint32_t level = 0;
  uint32_t quiet_level = 0;  ///< nothing is known of those below it
  SurfaceScale scale;
};

Result<KnownSurface> surfaceOf(tks_decoder& decoder, uint32_t level) {
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
  return KnownSurface{ofMipLevel(geometry->heights, g.width, g.height, level), level,
                      level + geometry->quiet_levels, surfaceScale(header, *geometry)};
}

/// Levels that nothing is known of are left out.
void skipQuiet(KnownSurface& known, uint32_t level) {
  if (level <= known.level) return;
  known.surface = coarsen(known.surface.view(), level - known.level);
  known.level = level;
}

struct ChosenMesh {
  std::vector<VertexId> vertices;
  FittedMesh mesh;
};

Result<ChosenMesh> fittedVertices(const CoarseSurface& surface, bool choose_coarser,
                                  uint32_t max_triangles) {
  const SurfaceView fine = surface.view();
  const CoarseSurface coarser = choose_coarser ? smoothed(fine) : CoarseSurface();
  const Result<FittedSequence> sequence =
      FittedSequence::makeFor({choose_coarser ? coarser.view() : fine, {}}, max_triangles);
  if (!sequence.ok()) return sequence.status();
  std::vector<VertexId> vertices = sequence->order();
  vertices.resize(sequence->longestPrefix(max_triangles));
  const Result<Lattice> lattice = Lattice::make(fine.width, fine.height);
  if (!lattice.ok()) return lattice.status();
  FittedMesh mesh = fitMesh(*lattice, {fine, {}}, vertices);
  return ChosenMesh{std::move(vertices), std::move(mesh)};
}

}  // namespace

uint32_t budgetMeshLevel(const Lattice& lattice, uint32_t max_triangles) {
  return std::max(spareLevels(lattice, kPerTriangle, max_triangles), 1u) - 1;
}

Result<SurfaceMesh> budgetMesh(tks_decoder& decoder, Lattice lattice, uint32_t max_triangles) {
  const uint32_t chosen_level = spareLevels(lattice, kPerTriangle, max_triangles);
  Result<KnownSurface> known = surfaceOf(decoder, budgetMeshLevel(lattice, max_triangles));
  if (!known.ok()) return known.status();
  const uint32_t quiet_level =
      std::min(known->quiet_level, spareLevels(lattice, kPerQuietTriangle, max_triangles));
  const uint32_t level = std::max(chosen_level, quiet_level);
  if (level > 0) skipQuiet(*known, level - 1);
  Result<ChosenMesh> fitted = fittedVertices(known->surface, level > 0, max_triangles);
  if (!fitted.ok()) return fitted.status();
  LatticeMesh mesh = std::move(fitted->mesh.mesh);
  for (uint32_t& sample : mesh.vertices)
    sample =
        wholeSample(sample, known->surface.width, lattice.width(), lattice.height(), known->level);
  std::vector<float> heights;
  heights.reserve(mesh.vertices.size());
  for (const double steps : fitted->mesh.heights)
    heights.push_back(static_cast<float>(steps * known->scale.scale + known->scale.offset));
  return SurfaceMesh{std::move(lattice), std::move(fitted->vertices), std::move(mesh),
                     std::move(heights)};
}

}  // namespace tetrakis
