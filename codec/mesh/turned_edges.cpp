// SPDX-License-Identifier: Apache-2.0
// Sweeps over half-edges in the order of the triangles, between least squares. Half-edge 3 t + k
// runs from corner k of triangle t to the next; its twin is that of the triangle on the other side.
#include "codec/mesh/fitted_heights.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline mesh {
namespace {

constexpr uint32_t kNoTwin = std::numeric_limits<uint32_t>::max();
/// Doubled area of the smallest triangle that a turned edge may leave: what has fewer samples is
/// right at all of them, and wrong between. Larger areas forbid turns that gain.
constexpr int64_t kLeastArea = 4;
/// A turn has to take this share off the error of two triangles, so that sweeps come to an end.
constexpr double kLeastGain = 0x1p-20;
/// Rounds of turning edges and fitting heights, and sweeps over all edges in each. Twice as many
/// rounds gain nothing; each takes time.
constexpr int kRounds = 3;
constexpr uint32_t kSweeps = 3;

uint32_t following(uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
uint32_t preceding(uint32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

int64_t doubledArea(GridPoint a, GridPoint b, GridPoint c) {
  return (int64_t{b.x} - a.x) * (int64_t{c.y} - a.y) - (int64_t{b.y} - a.y) * (int64_t{c.x} - a.x);
}

std::vector<uint32_t> twinsOf(std::span<const uint32_t> corners) {
  struct Edge {
    uint32_t low, high, half_edge;
    bool operator<(const Edge& e) const {
      return std::array{low, high, half_edge} < std::array{e.low, e.high, e.half_edge};
    }
  };
  std::vector<Edge> edges;
  edges.reserve(corners.size());
  for (uint32_t h = 0; h < corners.size(); ++h) {
    const auto [low, high] = std::minmax(corners[h], corners[following(h)]);
    edges.push_back({low, high, h});
  }
  std::sort(edges.begin(), edges.end());
  std::vector<uint32_t> twins(corners.size(), kNoTwin);
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].low != edges[i + 1].low || edges[i].high != edges[i + 1].high) continue;
    twins[edges[i].half_edge] = edges[i + 1].half_edge;
    twins[edges[i + 1].half_edge] = edges[i].half_edge;
  }
  return twins;
}

class EdgeTurner {
 public:
  EdgeTurner(const WeightedSurface& surface, FittedMesh mesh)
      : surface_(surface),
        mesh_(std::move(mesh)),
        corners_(mesh_.mesh.triangles),
        twins_(twinsOf(corners_)),
        errors_(corners_.size() / 3),
        changes_(errors_.size()),
        by_sample_(surface.view.heights.size()) {
    const uint32_t width = surface.view.width;
    for (const uint32_t sample : mesh_.mesh.vertices)
      points_.push_back({sample % width, sample / width});
    for (size_t t = 0; t < errors_.size(); ++t) fixed_.push_back(touchesUnknown(t));
  }

  FittedMesh turned() && {
    for (int round = 0; round < kRounds; ++round) {
      for (size_t t = 0; t < errors_.size(); ++t) errors_[t] = errorOf(cornersOf(t));
      std::fill(changes_.begin(), changes_.end(), 0u);
      for (uint32_t pass = 1; pass <= kSweeps && sweep(pass); ++pass) {
      }
      fit();
    }
    return std::move(mesh_);
  }

 private:
  using Corners = std::array<uint32_t, 3>;  ///< vertices of the mesh

  Corners cornersOf(size_t t) const {
    return {corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]};
  }
  HeldTriangle held(const Corners& c) const {
    return {{points_[c[0]], points_[c[1]], points_[c[2]]},
            {mesh_.heights[c[0]], mesh_.heights[c[1]], mesh_.heights[c[2]]}};
  }
  double errorOf(const Corners& c) const { return squaredErrorOf(surface_, held(c)); }
  int64_t areaOf(const Corners& c) const {
    return doubledArea(points_[c[0]], points_[c[1]], points_[c[2]]);
  }

  bool touchesUnknown(size_t t) const {
    if (surface_.known.empty()) return false;
    bool unknown = false;
    const Corners c = cornersOf(t);
    TriangleSamples({points_[c[0]], points_[c[1]], points_[c[2]]})
        .forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges&) {
          unknown |= !surface_.isKnown(size_t{y} * surface_.view.width + x);
        });
    return unknown;
  }

  /// Edges between triangles that nothing has changed since the pass before are as they were.
  bool sweep(uint32_t pass) {
    bool turned = false;
    for (uint32_t h = 0; h < corners_.size(); ++h) {
      const uint32_t twin = twins_[h];
      if (twin == kNoTwin || twin < h || fixed_[h / 3] || fixed_[twin / 3]) continue;
      if (std::max(changes_[h / 3], changes_[twin / 3]) + 1 < pass) continue;
      turned |= turn(h, twin, pass);
    }
    return turned;
  }

  ///      b               b         Seen with the sense of rotation of all triangles: h runs from a
  ///    / | \           /   \       to b in the triangle whose third corner is c, its twin back in
  ///   c  |  d   =>    c --- d      that of d. These become (c, a, d) and (d, b, c).
  ///    \ | /           \   /
  ///      a               a
  bool turn(uint32_t h, uint32_t twin, uint32_t pass) {
    const uint32_t a = corners_[h], b = corners_[twin];
    const uint32_t c = corners_[preceding(h)], d = corners_[preceding(twin)];
    const Corners first = {c, a, d}, second = {d, b, c};
    const int64_t sense = areaOf(cornersOf(h / 3)) > 0 ? 1 : -1;
    if (sense * areaOf(first) < kLeastArea || sense * areaOf(second) < kLeastArea) return false;
    const double before = errors_[h / 3] + errors_[twin / 3];
    if (before == 0) return false;
    const double first_error = errorOf(first);
    if (!(first_error < before)) return false;
    const double second_error = errorOf(second);
    if (!(first_error + second_error < before * (1 - kLeastGain))) return false;
    replace(h, twin, first, second);
    errors_[h / 3] = first_error;
    errors_[twin / 3] = second_error;
    changes_[h / 3] = changes_[twin / 3] = pass;
    return true;
  }

  void replace(uint32_t h, uint32_t twin, const Corners& first, const Corners& second) {
    const uint32_t ca = twins_[preceding(h)], ad = twins_[following(twin)];
    const uint32_t db = twins_[preceding(twin)], bc = twins_[following(h)];
    const uint32_t one = h - h % 3, two = twin - twin % 3;
    std::copy(first.begin(), first.end(), corners_.begin() + one);
    std::copy(second.begin(), second.end(), corners_.begin() + two);
    join(one, ca);
    join(one + 1, ad);
    join(one + 2, two + 2);
    join(two, db);
    join(two + 1, bc);
  }
  void join(uint32_t h, uint32_t twin) {
    twins_[h] = twin;
    if (twin != kNoTwin) twins_[twin] = h;
  }

  void fit() {
    const std::vector<uint32_t>& vertices = mesh_.mesh.vertices;
    for (size_t v = 0; v < vertices.size(); ++v) by_sample_[vertices[v]] = mesh_.heights[v];
    std::vector<FittedLeaf> leaves;
    leaves.reserve(errors_.size());
    for (size_t t = 0; t < errors_.size(); ++t) {
      const Corners c = cornersOf(t);
      leaves.push_back(
          {{vertices[c[0]], vertices[c[1]], vertices[c[2]]}, momentsOf(surface_, held(c))});
    }
    const HeightCorrections fitted = fittedCorrections(surface_, leaves, by_sample_);
    for (size_t i = 0; i < fitted.samples.size(); ++i)
      by_sample_[fitted.samples[i]] += fitted.corrections[i];
    for (size_t v = 0; v < vertices.size(); ++v) mesh_.heights[v] = by_sample_[vertices[v]];
  }

  const WeightedSurface& surface_;
  FittedMesh mesh_;
  std::vector<uint32_t>& corners_;  ///< of the triangles of mesh_
  std::vector<uint32_t> twins_;     ///< of each half-edge
  std::vector<double> errors_;      ///< of each triangle, as the next two
  std::vector<uint32_t> changes_;   ///< the last pass that changed it
  std::vector<bool> fixed_;
  std::vector<GridPoint> points_;  ///< of each vertex
  std::vector<double> by_sample_;  ///< heights
};

}  // namespace

FittedMesh withTurnedEdges(const WeightedSurface& surface, FittedMesh mesh) {
  assert(mesh.heights.size() == mesh.mesh.vertices.size());
  if (mesh.mesh.triangles.empty()) return mesh;
  return EdgeTurner(surface, std::move(mesh)).turned();
}

}  // namespace tetrakis::inline mesh
