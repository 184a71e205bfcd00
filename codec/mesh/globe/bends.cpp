// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/globe/bends.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

#include "codec/mesh/surface/surface.hpp"

namespace tetrakis::inline globe {
namespace {

constexpr uint32_t kTurnParts = 64, kFewestTurnParts = 8;

uint64_t trianglesOf(const Lattice& lattice, uint32_t side) {
  const auto squares = [side](uint32_t samples) { return (samples - 2) / side + uint64_t{1}; };
  return 2 * squares(lattice.width()) * squares(lattice.height());
}

/// Those before `level` that are not inserted, parents first.
std::vector<VertexId> missing(const Lattice& lattice, std::span<const VertexId> inserted,
                              uint32_t level) {
  std::vector<bool> there(lattice.firstOf(level));
  for (const VertexId v : inserted)
    if (v < there.size()) there[v] = true;
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < there.size(); ++v)
    if (!there[v]) vertices.push_back(v);
  return vertices;
}

/// The ends of the edge that a vertex splits.
std::array<GridPoint, 2> splitEdge(const Lattice& lattice, Site v) {
  const GridPoint p = lattice.position(v);
  const uint32_t step = lattice.plan(v.level).step;
  if (!Lattice::isCentre(v.level)) {
    if (v.column % 2 == 1) return {{{p.x - step, p.y}, {p.x + step, p.y}}};
    return {{{p.x, p.y - step}, {p.x, p.y + step}}};
  }
  // The corners of even coordinate sum.
  if ((v.column + v.row) % 2 == 0) return {{{p.x - step, p.y - step}, {p.x + step, p.y + step}}};
  return {{{p.x + step, p.y - step}, {p.x - step, p.y + step}}};
}

/// The lattice of every 2^k-th sample (codec/mesh/surface/surface.hpp), which holds all vertices up
/// to one: as large as the mesh needs, not as the grid.
struct CoarseLattice {
  uint32_t k;
  Lattice lattice;

  static CoarseLattice upTo(const Lattice& whole, VertexId finest) {
    const uint32_t k = whole.plan(whole.site(finest).level).shift;
    Result<Lattice> lattice =
        Lattice::make(coarseSide(whole.width(), k), coarseSide(whole.height(), k));
    assert(lattice.ok());
    return {k, std::move(*lattice)};
  }
};

}  // namespace

uint32_t bendLevel(const Lattice& lattice, uint32_t max_triangles) {
  const auto goesOn = [&](uint32_t side) {
    if (uint64_t{side} * kFewestTurnParts > lattice.width()) return true;
    return uint64_t{side} * kTurnParts > lattice.width() &&
           (max_triangles == 0 || 2 * trianglesOf(lattice, side / 2) <= max_triangles);
  };
  uint32_t level = 0;
  for (uint32_t side = lattice.rootSide(); level < lattice.levelCount() && goesOn(side); side /= 2)
    level += 2;
  return level;
}

uint32_t cubeBendLevel(uint32_t depth, uint32_t max_triangles) {
  constexpr uint64_t kFaces = 6, kAround = 4;  // of a cube, and round its equator
  uint32_t splits = 0;
  const auto goesOn = [&] {
    if (kAround << splits < kFewestTurnParts) return true;
    return kAround << splits < kTurnParts &&
           (max_triangles == 0 || 2 * (2 * kFaces << 2 * (splits + 1)) <= max_triangles);
  };
  while (splits < depth && goesOn()) ++splits;
  return 2 * splits;
}

void addBends(const Lattice& lattice, std::span<const VertexId> inserted, uint32_t level,
              Mask valid, LatticeMesh& mesh, std::vector<float>& heights) {
  const std::vector<VertexId> added = missing(lattice, inserted, level);
  if (added.empty()) return;
  std::vector<VertexId> all(inserted.begin(), inserted.end());
  all.insert(all.end(), added.begin(), added.end());
  const auto [k, coarse] = CoarseLattice::upTo(lattice, *std::max_element(all.begin(), all.end()));
  LatticeMesh bent = meshOf(coarse, all);
  std::vector<float> at(coarse.sampleCount());
  for (size_t v = 0; v < heights.size(); ++v) at[bent.vertices[v]] = heights[v];
  for (const VertexId v : added) {
    const Site site = coarse.site(v);
    if (coarse.hidden(site)) continue;
    const auto [from, to] = splitEdge(coarse, site);
    const double sum = double{at[coarse.gridIndex(from)]} + at[coarse.gridIndex(to)];
    const auto height = static_cast<float>(sum / 2);
    at[coarse.gridIndex(coarse.position(site))] = height;
    heights.push_back(height);
  }
  assert(heights.size() == bent.vertices.size());
  for (size_t v = 0; v < heights.size(); ++v) {
    uint32_t& sample = bent.vertices[v];
    sample = wholeSample(sample, coarse.width(), lattice.width(), lattice.height(), k);
    if (!valid[sample]) heights[v] = std::numeric_limits<float>::quiet_NaN();
  }
  mesh = std::move(bent);
}

}  // namespace tetrakis::inline globe
