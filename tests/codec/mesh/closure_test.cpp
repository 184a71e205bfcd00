// SPDX-License-Identifier: Apache-2.0
// The hull of all meshes against every closed set of small lattices, and orders against the hull.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "codec/mesh/closure/closure.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"
#include "tests/support/closed_sets.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

std::vector<int32_t> ridges(uint32_t width, uint32_t height, uint32_t seed) {
  std::minstd_rand random(seed);
  std::vector<int32_t> heights;
  for (int32_t y = 0; y < static_cast<int32_t>(height); ++y)
    for (int32_t x = 0; x < static_cast<int32_t>(width); ++x)
      heights.push_back(5 * x * x - 3 * x * y + 40 * std::abs(3 * x - 5 * y) +
                        static_cast<int32_t>(random() % 101));
  return heights;
}

/// Random whole gains: exact sums, ties, and gains below 0.
std::vector<double> randomGains(size_t count, uint32_t seed) {
  std::minstd_rand random(seed);
  std::vector<double> gains(count);
  for (double& g : gains) g = static_cast<double>(random() % 41) - 12;
  return gains;
}

/// The most that any closed set of each cost gains.
std::map<uint32_t, double> bestOfAllClosedSets(const Lattice& lattice,
                                               const std::vector<double>& gains) {
  std::map<uint32_t, double> best;
  std::vector<bool> in(lattice.vertexCount());
  const auto visit = [&](auto&& self, VertexId v, uint32_t cost, double gain) -> void {
    if (v == in.size()) {
      const auto [place, fresh] = best.try_emplace(cost, gain);
      if (!fresh) place->second = std::max(place->second, gain);
      return;
    }
    self(self, v + 1, cost, gain);
    const Site site = lattice.site(v);
    bool allowed = true;
    lattice.forEachParent(site, [&](Site p) { allowed = allowed && in[lattice.id(p)]; });
    if (!allowed) return;
    in[v] = true;
    self(self, v + 1, cost + lattice.triangleCost(site), gain + gains[v]);
    in[v] = false;
  };
  visit(visit, 0, 0, 0);
  return best;
}

void expectHullOfAllClosedSets(const Lattice& lattice, const std::vector<double>& gains) {
  const std::vector<double> slopes = closureSlopes(lattice, gains);
  const MeshHull hull(lattice, gains, slopes);
  const double total = std::accumulate(gains.begin(), gains.end(), 0.0);
  const auto best = bestOfAllClosedSets(lattice, gains);
  const uint32_t roots = hull.corners().front().triangles;
  for (const auto& [cost, gain] : best)
    EXPECT_LE(hull.bound(roots + cost), total - gain + 1e-9) << "no bound at " << cost;
  for (const MeshHull::Corner& corner : hull.corners()) {
    const auto reached = best.find(corner.triangles - roots);
    ASSERT_TRUE(reached != best.end());
    EXPECT_NEAR(corner.squared_error, total - reached->second, 1e-9) << "no mesh at a corner";
  }
}

const std::vector<std::pair<uint32_t, uint32_t>> kSizes = {{2, 2}, {3, 3}, {3, 5}, {5, 4},
                                                           {4, 4}, {2, 7}, {5, 5}, {4, 6}};

TEST(Closure, HullIsThatOfAllClosedSets) {
  for (const auto& [width, height] : kSizes)
    for (uint32_t seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", seed " << seed);
      const Lattice lattice = *Lattice::make(width, height);
      expectHullOfAllClosedSets(lattice, randomGains(lattice.vertexCount(), seed));
      const std::vector<int32_t> heights = ridges(width, height, seed);
      expectHullOfAllClosedSets(lattice, vertexGains(lattice, {width, height, heights}));
    }
}

TEST(Closure, SlopesNeverRiseFromParentToChild) {
  for (const auto& [width, height] : {std::pair{33u, 33u}, {40u, 23u}, {9u, 70u}}) {
    const Lattice lattice = *Lattice::make(width, height);
    const std::vector<double> slopes =
        closureSlopes(lattice, randomGains(lattice.vertexCount(), 3));
    for (VertexId v = 0; v < lattice.vertexCount(); ++v)
      lattice.forEachParent(lattice.site(v),
                            [&](Site parent) { EXPECT_GE(slopes[lattice.id(parent)], slopes[v]); });
  }
}

/// At any slope, no vertex with its ancestors or descendants can change sides to advantage: the
/// optimum for a set without exchanges of several vertices, on lattices too large for all sets.
TEST(Closure, SetsOfLargeLatticesCannotBeImprovedByOneDomain) {
  const uint32_t side = 65;
  const Lattice lattice = *Lattice::make(side, side);
  const std::vector<int32_t> heights = ridges(side, side, 7);
  const std::vector<double> gains = vertexGains(lattice, {side, side, heights});
  const std::vector<double> slopes = closureSlopes(lattice, gains);
  const double lambda = slopes[lattice.vertexCount() / 3] * (1 + 1e-9) + 1e-9;
  const auto worth = [&](VertexId v) {
    return gains[v] - lambda * lattice.triangleCost(lattice.site(v));
  };
  std::vector<bool> chosen(lattice.vertexCount());
  for (VertexId v = 0; v < chosen.size(); ++v) chosen[v] = slopes[v] > lambda;
  for (VertexId v = 0; v < chosen.size(); ++v) {
    double change = 0;
    if (chosen[v]) {
      std::vector<VertexId> domain = {v};
      for (size_t i = 0; i < domain.size(); ++i)
        lattice.forEachChild(lattice.site(domain[i]), [&](Site child) {
          const VertexId id = lattice.id(child);
          if (chosen[id] && std::find(domain.begin(), domain.end(), id) == domain.end())
            domain.push_back(id);
        });
      for (const VertexId w : domain) change -= worth(w);
    } else {
      const VertexId seed[] = {v};
      for (const VertexId w : closureOf(lattice, seed))
        if (!chosen[w]) change += worth(w);
    }
    EXPECT_LE(change, 1e-6 * std::abs(lambda)) << v;
  }
}

TEST(Closure, SlopesOfAClosedSetIgnoreTheRest) {
  const Lattice lattice = *Lattice::make(17, 17);
  const std::vector<double> gains = randomGains(lattice.vertexCount(), 5);
  const VertexId seeds[] = {lattice.vertexCount() - 1, lattice.vertexCount() / 2};
  const std::vector<VertexId> set = closureOf(lattice, seeds);
  std::vector<double> some, others = gains;
  for (VertexId v = 0; v < others.size(); ++v)
    if (!std::binary_search(set.begin(), set.end(), v)) others[v] = -1e6;  // never worth it
  for (const VertexId v : set) some.push_back(gains[v]);
  const std::vector<double> slopes = closureSlopes(lattice, set, some);
  const std::vector<double> all = closureSlopes(lattice, others);
  for (size_t i = 0; i < set.size(); ++i) EXPECT_NEAR(slopes[i], all[set[i]], 1e-6);
}

TEST(Closure, GreedyOrderIsNeverBelowTheHullAndNearIt) {
  for (const auto& [width, height] : {std::pair{65u, 65u}, {90u, 50u}}) {
    const std::vector<int32_t> heights = ridges(width, height, 11);
    const SurfaceView surface{width, height, heights};
    const MeshSequence greedy = *decimate(surface);
    const std::vector<double> gains = vertexGains(greedy.lattice(), surface);
    const MeshHull hull(greedy.lattice(), gains, closureSlopes(greedy.lattice(), gains));
    for (size_t n = 0; n <= greedy.order().size(); ++n) {
      const double bound = hull.bound(greedy.triangleCount(n));
      ASSERT_GE(greedy.squaredError(n), bound * (1 - 1e-12) - 1e-6) << n;
    }
    const size_t many = greedy.bestPrefix(greedy.triangleCount(greedy.order().size()) / 10);
    EXPECT_LT(greedy.squaredError(many), 1.02 * hull.bound(greedy.triangleCount(many)));
  }
}

TEST(Closure, OptimalSequencePassesThroughEveryCorner) {
  for (const auto& [width, height] : {std::pair{33u, 33u}, {50u, 21u}, {6u, 7u}}) {
    const std::vector<int32_t> heights = ridges(width, height, 2);
    const SurfaceView surface{width, height, heights};
    const Result<MeshSequence> sequence = decimateOptimally(surface);
    ASSERT_TRUE(sequence.ok());
    const Lattice& lattice = sequence->lattice();
    const std::vector<double> gains = vertexGains(lattice, surface);
    const MeshHull hull(lattice, gains, closureSlopes(lattice, gains));
    for (const MeshHull::Corner& corner : hull.corners()) {
      const size_t n = sequence->bestPrefix(corner.triangles);
      EXPECT_NEAR(sequence->squaredError(n), corner.squared_error,
                  1e-9 * sequence->squaredError(0));
    }
    checks::expectConforming(sequence->mesh(sequence->order().size() / 3), width, height);
  }
}

/// Sides against the corners of the hull on either side of a number of triangles.
TEST(Closure, SidesAreThoseOfTheCorners) {
  for (const auto& [width, height] : {std::pair{33u, 33u}, {50u, 21u}, {6u, 7u}}) {
    const Lattice lattice = *Lattice::make(width, height);
    const std::vector<int32_t> heights = ridges(width, height, 4);
    const std::vector<double> gains = vertexGains(lattice, {width, height, heights});
    const MeshHull hull(lattice, gains, closureSlopes(lattice, gains));
    const std::vector<VertexId> all = allVertices(lattice);
    const uint32_t roots = hull.corners().front().triangles;
    for (uint32_t triangles = roots; triangles < 2 * width * height; triangles += 7) {
      const std::vector<double> sides = hullSides(lattice, all, gains, triangles);
      uint32_t within = roots, across = 0;
      for (const VertexId v : all) {
        const uint32_t cost = lattice.triangleCost(lattice.site(v));
        within += sides[v] == hull_side::kWithin ? cost : 0;
        across += sides[v] == hull_side::kAcross ? cost : 0;
        lattice.forEachParent(lattice.site(v),
                              [&](Site parent) { EXPECT_GE(sides[lattice.id(parent)], sides[v]); });
      }
      const auto after =
          std::upper_bound(hull.corners().begin(), hull.corners().end(), triangles,
                           [](uint32_t t, const auto& corner) { return t < corner.triangles; });
      EXPECT_EQ(within, (after - 1)->triangles) << triangles;
      if (after != hull.corners().end()) {
        EXPECT_EQ(within + across, after->triangles) << triangles;
      }
    }
  }
}

TEST(Closure, DefaultOrderIsOnTheHullWhereTrianglesAreFew) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const std::vector<int32_t> heights = ridges(90, 77, seed);
    const SurfaceView surface{90, 77, heights};
    const MeshSequence sequence = *decimate(surface);
    const std::vector<double> gains = vertexGains(sequence.lattice(), surface);
    const MeshHull hull(sequence.lattice(), gains, closureSlopes(sequence.lattice(), gains));
    for (const MeshHull::Corner& corner : hull.corners())
      if (corner.triangles < 90 * 77 / 16) {
        EXPECT_LE(sequence.squaredError(sequence.bestPrefix(corner.triangles)),
                  1.002 * corner.squared_error)
            << corner.triangles;
      }
  }
}

TEST(Closure, RefusesWhatTheLatticeRefuses) {
  const std::vector<int32_t> heights(5);
  EXPECT_EQ(decimateOptimally({1, 5, heights}).status().code(), TKS_USAGE);
}

/// Every loan of the flow is used: a chain that pays for a costly ancestor only together.
TEST(Closure, SharedAncestorsArePaidForTogether) {
  // 0 is the parent of 1, 2, 3, each of which alone cannot pay for it.
  constexpr uint32_t kNone = ClosureFlow::kNone;
  ClosureFlow flow({{kNone, kNone}, {0, kNone}, {0, kNone}, {0, kNone}});
  const std::vector<uint32_t> all = {0, 1, 2, 3};
  flow.solve(all, std::vector<int64_t>{-10, 4, 4, 3});
  EXPECT_TRUE(flow.inClosure(0) && flow.inClosure(1) && flow.inClosure(2) && flow.inClosure(3));
  flow.solve(all, std::vector<int64_t>{-12, 4, 4, 3});
  EXPECT_FALSE(flow.inClosure(0) || flow.inClosure(1) || flow.inClosure(2) || flow.inClosure(3));
}

}  // namespace
}  // namespace tetrakis
