// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/void_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "codec/mesh/decimation.hpp"
#include "codec/mesh/fitted_solver.hpp"

namespace tetrakis::inline mesh {

namespace {

std::vector<int32_t> heightsOverPits(const WeightedSurface& surface) {
  const std::span<const uint8_t> valid = surface.known;
  std::vector<int32_t> heights(surface.view.heights.begin(), surface.view.heights.end());
  int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < heights.size(); ++i) {
    if (!valid.empty() && !valid[i]) continue;
    low = std::min(low, heights[i]);
    high = std::max(high, heights[i]);
  }
  const int64_t depth = (int64_t{high} - low) / 4 + 1;
  const auto floor =
      static_cast<int32_t>(std::max<int64_t>(low - depth, std::numeric_limits<int32_t>::min()));
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) heights[i] = low <= high ? floor : 0;
  }
  return heights;
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

}  // namespace

Result<FittedVertices> verticesBesideVoids(const Lattice& lattice, const WeightedSurface& surface,
                                           uint32_t max_triangles,
                                           const std::function<Status(uint64_t)>& admits) {
  assert(surface.view.heights.size() == lattice.sampleCount());
  assert(surface.known.empty() || surface.known.size() == lattice.sampleCount());
  const std::vector<int32_t> pits = heightsOverPits(surface);
  const Result<MeshSequence> sequence =
      decimate({lattice.width(), lattice.height(), pits, surface.view.weights});
  if (!sequence.ok()) return sequence.status();
  FittedVertices result{sequence->order(), {}};
  result.vertices.resize(longestOnLand(*sequence, surface.known, max_triangles));
  const Status admitted = admits(sequence->triangleCount(result.vertices.size()));
  if (!admitted.ok()) return admitted;
  FittedMoments fitted(lattice, surface);
  fitted.coarsen(result.vertices);
  fitHeights(fitted);
  for (const uint32_t sample : meshOf(lattice, result.vertices).vertices)
    result.heights.push_back(fitted.height(sample));
  return result;
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
