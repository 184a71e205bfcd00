// SPDX-License-Identifier: Apache-2.0
// Meshes of the raster itself; see decimation_quality.hpp.
#include "bench/meshes/decimation_quality.hpp"

#include <algorithm>
#include <cmath>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"

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

namespace {

/// A terrain that some triangles already show without error has no gap.
double decibels(double error, double bound) {
  return error > 0 && bound > 0 ? 10 * std::log10(error / bound) : 0;
}

double gapToChord(const MeshSequence& sequence, const MeshHull& hull, uint32_t budget) {
  const size_t inserted = sequence.bestPrefix(budget);
  return decibels(sequence.squaredError(inserted), hull.bound(sequence.triangleCount(inserted)));
}

MeshHull::Corner nearestCorner(const MeshHull& hull, double triangles) {
  return *std::min_element(hull.corners().begin(), hull.corners().end(),
                           [&](const MeshHull::Corner& a, const MeshHull::Corner& b) {
                             return std::abs(std::log(a.triangles / triangles)) <
                                    std::abs(std::log(b.triangles / triangles));
                           });
}

}  // namespace

Result<std::vector<GapPoint>> gapsToHull(const Raster& raster) {
  constexpr int kRates = 20;
  constexpr double kFewest = 100, kMost = 0.9;
  const std::vector<int32_t> heights = wholeHeights(raster);
  const SurfaceView surface{raster.width, raster.height, heights};
  const Result<MeshSequence> sequence = decimate(surface);
  if (!sequence.ok()) return sequence.status();
  const std::vector<double> gains = vertexGains(sequence->lattice(), surface);
  const MeshHull hull(sequence->lattice(), gains, closureSlopes(sequence->lattice(), gains));
  const double ratio = kMost * sequence->triangleCount(sequence->order().size()) / kFewest;
  const Result<MeshSequence> optimal = decimateOptimally(surface);
  if (!optimal.ok()) return optimal.status();
  std::vector<GapPoint> points;
  for (int i = 0; i < kRates; ++i) {
    const double rate = kFewest * std::pow(ratio, static_cast<double>(i) / (kRates - 1));
    const auto budget = static_cast<uint32_t>(rate);
    const MeshHull::Corner corner = nearestCorner(hull, rate);
    const double error = sequence->squaredError(sequence->bestPrefix(corner.triangles));
    points.push_back({corner.triangles, decibels(error, corner.squared_error), budget,
                      gapToChord(*sequence, hull, budget), gapToChord(*optimal, hull, budget)});
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
