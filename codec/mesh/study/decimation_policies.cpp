// SPDX-License-Identifier: Apache-2.0
// localErrors(), restrictedDecimation() and refinement() order single vertices by fixed slopes, for
// errors of any kind, and decimate() chooses among such policies.
#include "codec/mesh/study/study.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/decimation/slope_queue.hpp"
#include "codec/mesh/decimation/worth.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline study {

// One descent over the forest: midpoints of split edges, planes where the forest overhangs.

namespace {

struct Corner {
  GridPoint point;
};
using Triangle = LatticeTriangle<Corner>;

class LocalErrors {
 public:
  LocalErrors(const Lattice& lattice, const SurfaceView& surface)
      : lattice_(lattice), surface_(surface), errors_(lattice.vertexCount()) {}

  std::vector<double> build() {
    forEachRootTriangle(
        lattice_, [](GridPoint p) { return Corner{p}; }, [&](const Triangle& t) { descend(t); });
    return std::move(errors_);
  }

 private:
  /// Depth at most levelCount().
  void descend(const Triangle& t) {
    if (t.level == lattice_.levelCount() || t.collapses(lattice_)) return;
    const Corner w{t.splitPoint()};
    // A clamped vertex may lie in one of the two triangles of its diamond only.
    double& error = errors_[lattice_.id(lattice_.siteAt(t.level, w.point))];
    error =
        std::max(error, t.overhangs(lattice_) ? clampedErrorIn(t, w.point) : errorIn(t, w.point));
    descend(t.first(w));
    descend(t.second(w));
  }

  double heightAt(GridPoint p) const { return surface_.heights[lattice_.gridIndex(p)]; }

  double errorIn(const Triangle& t, GridPoint split) const {
    const double delta = heightAt(split) - 0.5 * (heightAt(t.a.point) + heightAt(t.b.point));
    return delta * delta * surface_.weightOf(lattice_.gridIndex(split));
  }

  double clampedErrorIn(const Triangle& t, GridPoint split) const {
    return clampedError(
        surface_,
        {lattice_.clamp(t.a.point), lattice_.clamp(t.b.point), lattice_.clamp(t.apex.point)},
        lattice_.clamp(split));
  }

  const Lattice& lattice_;
  const SurfaceView& surface_;
  std::vector<double> errors_;
};

}  // namespace

std::vector<double> localErrors(const Lattice& lattice, const SurfaceView& surface) {
  assert(surface.width == lattice.width() && surface.height == lattice.height());
  return LocalErrors(lattice, surface).build();
}

// Topological orders of the parent relation, greedily from below or from above.

namespace {

using Ready = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

/// Vertices that wait for nobody, least first. candidate(Site, VertexId) -> Candidate;
/// forEachBlocker(Site, visit) visits whom a vertex waits for, forEachBlocked who waits for it.
template <class MakeCandidate, class ForEachBlocker, class ForEachBlocked>
std::vector<VertexId> greedyOrder(const Lattice& lattice, MakeCandidate&& candidate,
                                  ForEachBlocker&& forEachBlocker,
                                  ForEachBlocked&& forEachBlocked) {
  std::vector<uint8_t> blockers(lattice.vertexCount());
  Ready ready;
  lattice.forEachVertex([&](Site site, VertexId v) {
    forEachBlocker(site, [&](Site) { ++blockers[v]; });
    if (blockers[v] == 0) ready.push(candidate(site, v));
  });
  std::vector<VertexId> order;
  order.reserve(blockers.size());
  while (!ready.empty()) {
    const VertexId v = ready.top().vertex;
    ready.pop();
    order.push_back(v);
    forEachBlocked(lattice.site(v), [&](Site blocked) {
      const VertexId id = lattice.id(blocked);
      if (--blockers[id] == 0) ready.push(candidate(blocked, id));
    });
  }
  assert(order.size() == blockers.size());  // no vertex waits for ever
  return order;
}

/// Restricted decimation: from full resolution down, each step removes the vertex of least slope
/// among those without remaining descendants (|M_v| = 1). All vertices, those removed last first.
/// errors: of each vertex, what its removal costs; may be negative.
std::vector<VertexId> restrictedDecimation(const std::vector<double>& errors,
                                           const VertexCosts& costs) {
  const Lattice& lattice = costs.lattice();
  std::vector<VertexId> order = greedyOrder(
      lattice,
      [&](Site site, VertexId v) {
        return Candidate{slopeOf(errors[v], costs.of(site, v)), v};
      },
      [&](Site site, auto&& visit) { lattice.forEachChild(site, visit); },
      [&](Site site, auto&& visit) { lattice.forEachParent(site, visit); });
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

std::vector<VertexId> refinement(const std::vector<double>& errors, const VertexCosts& costs) {
  const Lattice& lattice = costs.lattice();
  return greedyOrder(
      lattice,
      [&](Site site, VertexId v) {
        const uint32_t cost = costs.of(site, v);
        return Candidate{
            cost == 0 ? -std::numeric_limits<double>::infinity() : -slopeOf(errors[v], cost), v};
      },
      [&](Site site, auto&& visit) { lattice.forEachParent(site, visit); },
      [&](Site site, auto&& visit) { lattice.forEachChild(site, visit); });
}

namespace {

Status check(const Lattice& lattice, const SurfaceView& surface, std::span<const uint32_t> costs) {
  if (Status status = checkWeights(surface); !status.ok()) return status;
  if (!costs.empty() && costs.size() != lattice.vertexCount())
    return {TKS_USAGE, "A mesh needs one cost for each lattice vertex, or none at all."};
  if (std::accumulate(costs.begin(), costs.end(), uint64_t{0}) > UINT32_MAX)
    return {TKS_LIMIT,
            "The costs of all vertices add up to more than 2^32 - 1; use a larger unit."};
  return {};
}

std::vector<VertexId> orderOf(const Lattice& lattice, const SurfaceView& surface,
                              const std::vector<double>& gains, const DecimationOptions& options) {
  const VertexCosts costs(lattice, options.costs);
  switch (options.policy) {
    case MeshPolicy::kNearHull:
    case MeshPolicy::kGeneralDecimation:
      break;
    case MeshPolicy::kRestrictedDecimation:
      return restrictedDecimation(gains, costs);
    case MeshPolicy::kLocalDecimation:
      return restrictedDecimation(localErrors(lattice, surface), costs);
    case MeshPolicy::kLocalRefinement:
      return refinement(localErrors(lattice, surface), costs);
  }
  return generalDecimation(gains, costs);
}

}  // namespace

Result<MeshSequence> decimate(const SurfaceView& surface, const DecimationOptions& options) {
  if (options.policy == MeshPolicy::kNearHull && options.costs.empty()) return decimate(surface);
  Result<Lattice> lattice = Lattice::make(surface.width, surface.height);
  if (!lattice.ok()) return lattice.status();
  if (const Status status = check(*lattice, surface, options.costs); !status.ok()) return status;
  const std::vector<double> gains = vertexGains(*lattice, surface);
  std::vector<VertexId> order = orderOf(*lattice, surface, gains, options);
  return MeshSequence(std::move(*lattice), std::move(order), gains);
}

}  // namespace tetrakis::inline study
