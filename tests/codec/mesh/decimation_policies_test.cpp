// SPDX-License-Identifier: Apache-2.0
// Other policies, weights and costs of RD decimation, each against its definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/decimation/merging_domains.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"
#include "codec/mesh/topology/ancestors.hpp"
#include "tests/support/closed_sets.hpp"
#include "tests/support/decimation_terrain.hpp"
#include "tests/support/mesh_checks.hpp"

namespace tetrakis {
namespace {

using checks::kReliefs;
using checks::kSizes;
using checks::Relief;
using checks::Terrain;

constexpr MeshPolicy kPolicies[] = {MeshPolicy::kNearHull, MeshPolicy::kGeneralDecimation,
                                    MeshPolicy::kRestrictedDecimation, MeshPolicy::kLocalDecimation,
                                    MeshPolicy::kLocalRefinement};

void setRandomWeights(Terrain& terrain) {
  std::minstd_rand random(3);
  for (size_t i = 0; i < terrain.heights.size(); ++i)
    terrain.weights.push_back(static_cast<float>(random() % 5) / 3);
}

std::vector<uint32_t> randomCosts(const Lattice& lattice) {
  std::minstd_rand random(5);
  std::vector<uint32_t> costs(lattice.vertexCount());
  for (uint32_t& cost : costs) cost = static_cast<uint32_t>(random() % 9);
  return costs;
}

/// What an order of single vertices may do next, from sets and slopes alone.
class SingleSteps {
 public:
  SingleSteps(const Lattice& lattice, const std::vector<double>& errors, bool refine)
      : lattice_(lattice), errors_(errors), refine_(refine), done_(lattice.vertexCount()) {}

  bool allowed(VertexId v) const {
    bool allowed = !done_[v];
    const auto need = [&](Site other) { allowed = allowed && done_[lattice_.id(other)]; };
    if (refine_)
      lattice_.forEachParent(lattice_.site(v), need);
    else
      lattice_.forEachChild(lattice_.site(v), need);
    return allowed;
  }
  /// Less comes first.
  double key(VertexId v) const {
    const uint32_t cost = lattice_.triangleCost(lattice_.site(v));
    if (!refine_) return slopeOf(errors_[v], cost);
    return cost == 0 ? -std::numeric_limits<double>::infinity() : -errors_[v] / cost;
  }
  void expectBestAndDo(VertexId v) {
    ASSERT_TRUE(allowed(v));
    for (VertexId w = 0; w < done_.size(); ++w)
      if (allowed(w)) {
        ASSERT_LE(key(v), key(w));
      }
    done_[v] = true;
  }

 private:
  const Lattice& lattice_;
  const std::vector<double>& errors_;
  const bool refine_;
  std::vector<bool> done_;
};

TEST(Policies, SingleStepsAreTheBestAllowed) {
  for (const auto& [width, height] : kSizes)
    for (const Relief relief : {Relief::kNoise, Relief::kTerrain, Relief::kSteps})
      for (const MeshPolicy policy : {MeshPolicy::kRestrictedDecimation,
                                      MeshPolicy::kLocalDecimation, MeshPolicy::kLocalRefinement}) {
        SCOPED_TRACE(testing::Message()
                     << width << " x " << height << ", policy " << static_cast<int>(policy));
        const Terrain terrain(width, height, relief);
        const Result<MeshSequence> sequence = decimate(terrain.view(), {policy, {}});
        const Lattice& lattice = sequence->lattice();
        const bool refine = policy == MeshPolicy::kLocalRefinement;
        const std::vector<double> errors = policy == MeshPolicy::kRestrictedDecimation
                                               ? vertexGains(lattice, terrain.view())
                                               : localErrors(lattice, terrain.view());
        std::vector<VertexId> order = sequence->order();
        if (!refine) std::reverse(order.begin(), order.end());
        SingleSteps steps(lattice, errors, refine);
        for (const VertexId v : order) steps.expectBestAndDo(v);
      }
}

TEST(Policies, EveryPrefixOfEveryPolicyConformsAndHasItsError) {
  for (const auto& [width, height] : kSizes)
    for (const MeshPolicy policy : kPolicies) {
      SCOPED_TRACE(testing::Message()
                   << width << " x " << height << ", policy " << static_cast<int>(policy));
      Terrain terrain(width, height, Relief::kTerrain);
      setRandomWeights(terrain);
      const Result<MeshSequence> sequence = decimate(terrain.view(), {policy, {}});
      ASSERT_TRUE(sequence.ok());
      for (size_t n = 0; n <= sequence->order().size(); n += 3) {
        const LatticeMesh mesh = sequence->mesh(n);
        checks::expectConforming(mesh, width, height);
        EXPECT_EQ(mesh.triangleCount(), sequence->triangleCount(n));
        const double error = bruteForceError(mesh, terrain);
        EXPECT_NEAR(sequence->squaredError(n), error,
                    1e-9 * error + 1e-9 * (1 + sequence->squaredError(0)));
      }
    }
}

/// The vertex's sample against the mesh of its ancestors.
TEST(LocalErrors, AreThoseOfTheMeshBeforeTheVertex) {
  for (const auto& [width, height] : kSizes) {
    Terrain terrain(width, height, Relief::kNoise);
    setRandomWeights(terrain);
    const Lattice lattice = *Lattice::make(width, height);
    const std::vector<double> errors = localErrors(lattice, terrain.view());
    for (VertexId v = 0; v < lattice.vertexCount(); ++v) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", vertex " << v);
      const Site site = lattice.site(v);
      if (lattice.hidden(site)) {
        EXPECT_EQ(errors[v], 0);
        continue;
      }
      std::vector<VertexId> before = closureOf(lattice, std::vector<VertexId>{v});
      before.erase(std::find(before.begin(), before.end(), v));
      const uint32_t sample = lattice.gridIndex(lattice.position(site));
      const double residual =
          terrain.heights[sample] - heightsOf(meshOf(lattice, before), terrain)[sample];
      const double error = residual * residual * static_cast<double>(terrain.weights[sample]);
      EXPECT_NEAR(errors[v], error, 1e-9 * (1 + error));
    }
  }
}

/// Thesis 5.4.2, 5.5.2: the mean over rates of the error in dB.
double meanDecibels(const Terrain& terrain, MeshPolicy policy) {
  const Result<MeshSequence> sequence = decimate(terrain.view(), {policy, {}});
  double sum = 0;
  int count = 0;
  for (uint32_t triangles = 16; triangles < 4000; triangles += triangles / 4, ++count)
    sum += 10 * std::log10(1 + sequence->squaredError(sequence->bestPrefix(triangles)));
  return sum / count;
}

TEST(Policies, GlobalErrorAndWholeDomainsGiveTheBestMeshes) {
  const Terrain terrain(65, 65, Relief::kTerrain);
  const double general = meanDecibels(terrain, MeshPolicy::kGeneralDecimation);
  const double restricted = meanDecibels(terrain, MeshPolicy::kRestrictedDecimation);
  EXPECT_LT(general, restricted);
  EXPECT_LT(restricted, meanDecibels(terrain, MeshPolicy::kLocalDecimation));
  EXPECT_LT(general, meanDecibels(terrain, MeshPolicy::kLocalRefinement));
}

/// Every step of general decimation from all remaining slopes, with costs that may be zero.
void expectGreedyChoices(const Terrain& terrain, std::span<const uint32_t> given) {
  const Lattice lattice = *Lattice::make(terrain.width, terrain.height);
  const Result<MeshSequence> sequence =
      decimate(terrain.view(), {MeshPolicy::kGeneralDecimation, given});
  ASSERT_TRUE(sequence.ok()) << sequence.status().message();
  const std::vector<double> gains = vertexGains(lattice, terrain.view());
  const VertexCosts costs(lattice, given);
  MergingDomains domains(gains, costs);
  auto end = sequence->order().end();
  while (end != sequence->order().begin()) {
    VertexId least = lattice.vertexCount();
    for (VertexId v = 0; v < lattice.vertexCount(); ++v)
      if (!domains.removed(v) &&
          (least == lattice.vertexCount() || domains.slope(v) < domains.slope(least)))
        least = v;
    const auto group = domains.remove(least, [](VertexId) {});
    ASSERT_LE(static_cast<ptrdiff_t>(group.size()), end - sequence->order().begin());
    ASSERT_TRUE(std::equal(group.begin(), group.end(), end - static_cast<ptrdiff_t>(group.size())));
    end -= static_cast<ptrdiff_t>(group.size());
  }
}

TEST(Policies, GeneralDecimationIsGreedyForAnyCostsAndWeights) {
  for (const auto& [width, height] : kSizes)
    for (const Relief relief : kReliefs) {
      SCOPED_TRACE(testing::Message()
                   << width << " x " << height << ", relief " << static_cast<int>(relief));
      Terrain terrain(width, height, relief);
      setRandomWeights(terrain);
      expectGreedyChoices(terrain, randomCosts(*Lattice::make(width, height)));
      expectGreedyChoices(terrain, {});
    }
}

TEST(Policies, GeneralDecimationIsGreedyOnLargerSurfaces) {
  for (const Relief relief : {Relief::kNoise, Relief::kTerrain, Relief::kSteps}) {
    expectGreedyChoices(Terrain(65, 65, relief), {});
    expectGreedyChoices(Terrain(50, 71, relief), {});
  }
}

TEST(Policies, TrianglesAreTheDefaultCost) {
  const Terrain terrain(37, 45, Relief::kTerrain);
  const Lattice lattice = *Lattice::make(37, 45);
  std::vector<uint32_t> costs(lattice.vertexCount());
  lattice.forEachVertex([&](Site site, VertexId v) { costs[v] = lattice.triangleCost(site); });
  for (const MeshPolicy policy : std::span(kPolicies).subspan(1))
    EXPECT_EQ(decimate(terrain.view(), {policy, costs})->order(),
              decimate(terrain.view(), {policy, {}})->order());
}

/// Sorted by the greatest slope at or below each vertex, and no shorter than was asked for.
TEST(Policies, SaturatedOrderFollowsTheBestDescendants) {
  for (const auto& [width, height] : kSizes) {
    const Terrain terrain(width, height, Relief::kNoise);
    const Lattice lattice = *Lattice::make(width, height);
    const std::vector<double> gains = vertexGains(lattice, terrain.view());
    std::vector<double> best(gains.size(), -std::numeric_limits<double>::infinity());
    uint32_t all = 0;
    lattice.forEachVertex([&](Site site, VertexId v) {
      const uint32_t cost = lattice.triangleCost(site);
      all += cost;
      if (cost == 0) return;
      best[v] = std::max(best[v], gains[v] / cost);
      forEachAncestor(lattice, site, [&](VertexId a) { best[a] = std::max(best[a], best[v]); });
    });
    for (const uint32_t most : {0u, all / 5, all / 2, all}) {
      const std::vector<VertexId> order = saturatedOrder(gains, VertexCosts(lattice), most);
      EXPECT_TRUE(std::is_sorted(order.begin(), order.end(),
                                 [&](VertexId v, VertexId w) { return best[v] > best[w]; }));
      std::vector<bool> inserted(gains.size());
      uint32_t cost = 0;
      for (const VertexId v : order) {
        EXPECT_FALSE(inserted[v]);
        inserted[v] = true;
        cost += lattice.triangleCost(lattice.site(v));
        lattice.forEachParent(lattice.site(v),
                              [&](Site parent) { EXPECT_TRUE(inserted[lattice.id(parent)]); });
      }
      EXPECT_GE(cost, most);
    }
  }
}

TEST(Policies, EqualWeightsScaleErrorsAndChangeNoOrder) {
  Terrain terrain(37, 45, Relief::kTerrain);
  for (const MeshPolicy policy : kPolicies) {
    terrain.weights.clear();
    const Result<MeshSequence> plain = decimate(terrain.view(), {policy, {}});
    terrain.weights.assign(terrain.heights.size(), 0.25f);
    const Result<MeshSequence> weighted = decimate(terrain.view(), {policy, {}});
    EXPECT_EQ(weighted->order(), plain->order());
    for (size_t n = 0; n <= plain->order().size(); ++n)
      EXPECT_EQ(weighted->squaredError(n), 0.25 * plain->squaredError(n));
  }
}

TEST(Policies, SamplesWithoutWeightCostNothing) {
  Terrain terrain(33, 33, Relief::kNoise);
  terrain.weights.assign(terrain.heights.size(), 0.0f);
  for (size_t i = 0; i < terrain.weights.size(); ++i)
    if (i % 33 < 12) terrain.weights[i] = 1;
  const Result<MeshSequence> sequence = decimate(terrain.view());
  const size_t enough = sequence->bestPrefix(std::numeric_limits<uint32_t>::max());
  EXPECT_EQ(sequence->squaredError(enough), 0);
  EXPECT_LT(sequence->triangleCount(enough), 2 * 32 * 32 * 2 / 3);
}

TEST(Policies, RefuseWeightsAndCostsThatMakeNoSense) {
  Terrain terrain(9, 9, Relief::kNoise);
  terrain.weights.assign(80, 1.0f);
  EXPECT_EQ(decimate(terrain.view()).status().code(), TKS_USAGE);
  for (const float bad : {-1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    terrain.weights.assign(81, 1.0f);
    terrain.weights[40] = bad;
    EXPECT_EQ(decimate(terrain.view()).status().code(), TKS_USAGE);
  }
  terrain.weights.clear();
  const size_t vertices = Lattice::make(9, 9)->vertexCount();
  const std::vector<uint32_t> few(vertices - 1, 1), huge(vertices, 1u << 31);
  EXPECT_EQ(decimate(terrain.view(), {MeshPolicy::kGeneralDecimation, few}).status().code(),
            TKS_USAGE);
  EXPECT_EQ(decimate(terrain.view(), {MeshPolicy::kGeneralDecimation, huge}).status().code(),
            TKS_LIMIT);
}

TEST(Policies, StepsOfGeneralDecimationEndInConformingMeshes) {
  const Terrain terrain(33, 20, Relief::kTerrain);
  const Lattice lattice = *Lattice::make(terrain.width, terrain.height);
  const std::vector<double> gains = vertexGains(lattice, terrain.view());
  std::vector<uint32_t> steps;
  const std::vector<VertexId> order =
      generalDecimation(gains, VertexCosts(lattice), MergingDomains::kPromptLevels, &steps);
  EXPECT_EQ(order, generalDecimation(gains, VertexCosts(lattice)));
  size_t left = order.size();
  for (const uint32_t removed : steps) {
    ASSERT_GE(removed, 1u);
    ASSERT_LE(removed, left);
    left -= removed;
    checks::expectConforming(meshOf(lattice, std::span(order).first(left)), 33, 20);
  }
  EXPECT_EQ(left, 0u);
  EXPECT_LT(steps.size(), order.size());  // domains of several vertices went
}

}  // namespace
}  // namespace tetrakis
