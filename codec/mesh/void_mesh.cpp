// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/meshes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/surface/surface.hpp"

namespace tetrakis::inline mesh {

namespace {

/// Valid samples for each triangle that are left where fine levels are skipped. At a coast
/// triangles are as small as samples are dense, so meshes want more samples here than elsewhere
/// (meshes.hpp). More samples take time.
constexpr uint64_t kValidPerTriangle = 20;
/// The part of the range of heights that voids lie below the lowest of them. Deeper pits draw more
/// triangles to the borders of voids.
constexpr int64_t kPitPart = 4;

/// Finest levels that can be left out with kValidPerTriangle samples left for each triangle.
uint32_t spareLevels(const WeightedSurface& surface, uint32_t max_triangles) {
  if (!surface.view.weights.empty() || surface.known.empty()) return 0;
  const auto known = static_cast<uint64_t>(
      std::count_if(surface.known.begin(), surface.known.end(), [](uint8_t v) { return v != 0; }));
  const uint32_t shorter = std::min(surface.view.width, surface.view.height) - 1;
  uint32_t k = 0;
  while (shorter >> (k + 1) > 0 && known >> (2 * (k + 1)) >= kValidPerTriangle * max_triangles) ++k;
  return k;
}

/// The surface with its voids as pits.
MaskedSurface withPits(MaskedSurface masked) {
  std::vector<int32_t>& heights = masked.surface.heights;
  int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < heights.size(); ++i) {
    if (!masked.valid[i]) continue;
    low = std::min(low, heights[i]);
    high = std::max(high, heights[i]);
  }
  const int64_t depth = (int64_t{high} - low) / kPitPart + 1;
  const auto floor =
      static_cast<int32_t>(std::max<int64_t>(low - depth, std::numeric_limits<int32_t>::min()));
  for (size_t i = 0; i < heights.size(); ++i) {
    if (!masked.valid[i]) heights[i] = low <= high ? floor : 0;
  }
  return masked;
}

/// Triangles of the mesh without a void corner.
size_t landTriangles(const LatticeMesh& mesh, std::span<const uint8_t> valid) {
  size_t count = 0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto on_land = [&](size_t corner) {
      return valid[mesh.vertices[mesh.triangles[t + corner]]] != 0;
    };
    count += on_land(0) && on_land(1) && on_land(2);
  }
  return count;
}

/// The longest prefix, as bisection finds it, of at most max_triangles on land: the same path for
/// every budget until their answers part, so that meshes stay nested.
size_t longestOnLand(const MeshSequence& sequence, std::span<const uint8_t> valid,
                     uint32_t max_triangles) {
  size_t low = 0, high = sequence.order().size();
  while (low < high) {
    const size_t middle = high - (high - low) / 2;
    if (landTriangles(sequence.mesh(middle), valid) <= max_triangles) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

struct BesideVoids {
  std::vector<VertexId> vertices;  ///< of the lattice of the whole surface as well
  uint64_t triangles = 0;          ///< those in voids included
};

/// Among every 2^k-th sample: those beside them hardly show in a mesh of so few triangles, and
/// decimation is what takes most of the time and memory.
Result<BesideVoids> chosenBesideVoids(const WeightedSurface& surface, uint32_t max_triangles) {
  const MaskedSurface pits = withPits(maskedSurface(surface, spareLevels(surface, max_triangles)));
  SurfaceView view = pits.surface.view();
  view.weights = surface.view.weights;
  const Result<MeshSequence> sequence = decimate(view);
  if (!sequence.ok()) return sequence.status();
  const size_t count = longestOnLand(*sequence, pits.valid, max_triangles);
  std::vector<VertexId> vertices(sequence->order().begin(),
                                 sequence->order().begin() + static_cast<ptrdiff_t>(count));
  return BesideVoids{std::move(vertices), sequence->triangleCount(count)};
}

}  // namespace

Result<FittedVertices> verticesBesideVoids(const Lattice& lattice, const WeightedSurface& surface,
                                           uint32_t max_triangles,
                                           const std::function<Status(uint64_t)>& admits) {
  assert(surface.view.heights.size() == lattice.sampleCount());
  assert(surface.known.empty() || surface.known.size() == lattice.sampleCount());
  Result<BesideVoids> chosen = chosenBesideVoids(surface, max_triangles);
  if (!chosen.ok()) return chosen.status();
  const Status admitted = admits(chosen->triangles);
  if (!admitted.ok()) return admitted;
  FittedMoments fitted(lattice, surface);
  fitted.coarsen(chosen->vertices);
  fitHeights(fitted);
  std::vector<double> heights;
  for (const uint32_t sample : meshOf(lattice, chosen->vertices).vertices)
    heights.push_back(fitted.height(sample));
  return FittedVertices{std::move(chosen->vertices), withinRange(surface, std::move(heights))};
}

void leaveOutVoids(LatticeMesh& mesh, std::vector<float>& heights) {
  assert(heights.size() == mesh.vertices.size());
  constexpr uint32_t kGone = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> renumbered(mesh.vertices.size(), kGone);
  uint32_t kept = 0;
  for (uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (std::isnan(heights[v])) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    heights[kept] = heights[v];
    renumbered[v] = kept++;
  }
  if (kept == mesh.vertices.size()) return;
  mesh.vertices.resize(kept);
  heights.resize(kept);
  size_t end = 0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const uint32_t corners[] = {renumbered[mesh.triangles[t]], renumbered[mesh.triangles[t + 1]],
                                renumbered[mesh.triangles[t + 2]]};
    if (std::find(std::begin(corners), std::end(corners), kGone) != std::end(corners)) continue;
    std::copy(std::begin(corners), std::end(corners),
              mesh.triangles.begin() + static_cast<ptrdiff_t>(end));
    end += 3;
  }
  mesh.triangles.resize(end);
}

}  // namespace tetrakis::inline mesh
