// SPDX-License-Identifier: Apache-2.0
// Meshes of the raster itself; see decimation_quality.hpp.
#include "bench/decimation_quality.hpp"

#include <algorithm>
#include <cmath>

#include "codec/closure.hpp"
#include "codec/fitted_heights.hpp"
#include "codec/gains.hpp"

namespace tetrakis::bench {
namespace {

std::vector<int32_t> wholeHeights(const Raster& raster) {
  return {raster.samples.begin(), raster.samples.end()};
}

}  // namespace

PlanMesh planMesh(const FittedMesh& fitted, uint32_t width) {
  PlanMesh mesh;
  for (size_t k = 0; k < fitted.heights.size(); ++k)
    mesh.positions.push_back({static_cast<float>(fitted.mesh.vertices[k] % width),
                              static_cast<float>(fitted.mesh.vertices[k] / width),
                              static_cast<float>(fitted.heights[k])});
  mesh.triangles = fitted.mesh.triangles;
  return mesh;
}

Result<std::vector<GapPoint>> gapsToHull(const Raster& raster) {
  constexpr int kRates = 20;
  constexpr double kFewest = 100, kMost = 0.9;
  const std::vector<int32_t> heights = wholeHeights(raster);
  const SurfaceView surface{raster.width, raster.height, heights};
  const Result<MeshSequence> greedy = decimate(surface);
  if (!greedy.ok()) return greedy.status();
  const std::vector<double> gains = vertexGains(greedy->lattice(), surface);
  const MeshHull hull(greedy->lattice(), gains, closureSlopes(greedy->lattice(), gains));
  const double ratio = kMost * greedy->triangleCount(greedy->order().size()) / kFewest;
  const Result<MeshSequence> optimal = decimateOptimally(surface);
  if (!optimal.ok()) return optimal.status();
  std::vector<GapPoint> points;
  for (int i = 0; i < kRates; ++i) {
    const auto budget =
        static_cast<uint32_t>(kFewest * std::pow(ratio, static_cast<double>(i) / (kRates - 1)));
    // On a terrain that some triangles already show without error, both errors are 0.
    const auto gap = [&](const MeshSequence& sequence) {
      const size_t inserted = sequence.bestPrefix(budget);
      const double error = sequence.squaredError(inserted);
      return error > 0 ? 10 * std::log10(error / hull.bound(sequence.triangleCount(inserted))) : 0;
    };
    points.push_back(
        {greedy->triangleCount(greedy->bestPrefix(budget)), gap(*greedy), gap(*optimal)});
  }
  return points;
}

Result<std::vector<MeshPoint>> comparedMeshes(const Raster& raster,
                                              const std::vector<PeerMesh>& peers) {
  const std::vector<int32_t> heights = wholeHeights(raster);
  const SurfaceView surface{raster.width, raster.height, heights};
  const Result<FittedSequence> sequence = FittedSequence::make({surface, raster.real});
  if (!sequence.ok()) return sequence.status();
  std::vector<MeshPoint> points;
  for (const PeerMesh& peer : peers) {
    const auto triangles = static_cast<uint32_t>(peer.mesh.triangleCount());
    points.push_back(
        {peer.peer, peer.budget, triangles, rmse(peer.mesh, raster),
         rmse(planMesh(sequence->mesh(sequence->longestPrefix(triangles)), raster.width), raster)});
  }
  return points;
}

}  // namespace tetrakis::bench
