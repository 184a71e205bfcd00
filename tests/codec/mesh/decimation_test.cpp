// SPDX-License-Identifier: Apache-2.0
// RD decimation against brute force: errors, greedy choices, nested and deterministic orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"
#include "tests/support/decimation_terrain.hpp"
#include "tests/support/mesh_checks.hpp"

namespace tetrakis {
namespace {

using checks::bruteForceError;
using checks::kReliefs;
using checks::kSizes;
using checks::Relief;
using checks::Terrain;

/// Conforms, and has the triangles and the error that the sequence states.
void expectPrefix(const MeshSequence& sequence, size_t inserted, const Terrain& terrain) {
  const LatticeMesh mesh = sequence.mesh(inserted);
  checks::expectConforming(mesh, terrain.width, terrain.height);
  EXPECT_EQ(mesh.triangleCount(), sequence.triangleCount(inserted));
  const double error = bruteForceError(mesh, terrain);
  EXPECT_NEAR(sequence.squaredError(inserted), error,
              1e-9 * error + 1e-12 * (1 + sequence.squaredError(0)));
}

TEST(Decimation, EveryPrefixConformsAndItsErrorIsThatOfTheSurface) {
  for (const auto& [width, height] : kSizes)
    for (const Relief relief : kReliefs) {
      const Terrain terrain(width, height, relief);
      const Result<MeshSequence> sequence = decimate(terrain.view());
      ASSERT_TRUE(sequence.ok());
      for (size_t n = 0; n <= sequence->order().size(); ++n) {
        SCOPED_TRACE(testing::Message() << width << " x " << height << ", relief "
                                        << static_cast<int>(relief) << ", " << n << " inserted");
        expectPrefix(*sequence, n, terrain);
        if (HasFailure()) return;
      }
    }
}

TEST(Decimation, PrefixesOfLargerGridsKeepTheirErrorToo) {
  const std::vector<std::pair<uint32_t, uint32_t>> sizes = {{33, 33}, {37, 45}, {66, 34}, {20, 90}};
  for (const auto& [width, height] : sizes) {
    const Terrain terrain(width, height, Relief::kTerrain);
    const Result<MeshSequence> sequence = decimate(terrain.view());
    const size_t count = sequence->order().size();
    for (size_t n = 0; n <= count; n += count / 9) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << n << " inserted");
      expectPrefix(*sequence, n, terrain);
    }
  }
}

/// Thesis 5.2.2 to the letter: every slope from scratch before every step.
class BruteForceGreedy {
 public:
  explicit BruteForceGreedy(const Terrain& terrain)
      : lattice_(*Lattice::make(terrain.width, terrain.height)),
        gains_(vertexGains(lattice_, terrain.view())),
        present_(lattice_.vertexCount(), true) {}

  /// The cheapest merging domain in order of id; empty when all are removed.
  std::vector<VertexId> next() {
    std::vector<VertexId> best;
    double least = 0;
    for (VertexId v = 0; v < present_.size(); ++v) {
      if (!present_[v]) continue;
      std::vector<VertexId> domain = mergingDomain(v);
      const double slope = slopeOf(domain);
      if (!best.empty() && slope >= least) continue;
      least = slope;
      best = std::move(domain);
    }
    for (const VertexId v : best) present_[v] = false;
    return best;
  }

 private:
  std::vector<VertexId> mergingDomain(VertexId v) const {
    std::vector<VertexId> domain = {v};
    for (size_t i = 0; i < domain.size(); ++i)
      lattice_.forEachChild(lattice_.site(domain[i]), [&](Site child) {
        const VertexId id = lattice_.id(child);
        if (present_[id] && std::find(domain.begin(), domain.end(), id) == domain.end())
          domain.push_back(id);
      });
    std::sort(domain.begin(), domain.end());
    return domain;
  }

  double slopeOf(const std::vector<VertexId>& domain) const {
    double distortion = 0;
    uint32_t triangles = 0;
    for (const VertexId v : domain) {
      distortion += gains_[v];
      triangles += lattice_.triangleCost(lattice_.site(v));
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (triangles == 0) return distortion > 0 ? kInfinity : -kInfinity;
    return distortion / triangles;
  }

  const Lattice lattice_;
  const std::vector<double> gains_;
  std::vector<bool> present_;
};

void expectGreedyChoices(const Terrain& terrain) {
  const Result<MeshSequence> sequence =
      decimate(terrain.view(), {MeshPolicy::kGeneralDecimation, {}});
  const std::vector<VertexId>& order = sequence->order();
  BruteForceGreedy greedy(terrain);
  auto end = order.end();
  while (end != order.begin()) {
    const std::vector<VertexId> expected = greedy.next();
    const auto count = static_cast<ptrdiff_t>(expected.size());
    ASSERT_LE(count, end - order.begin());
    std::vector<VertexId> removed(end - count, end);
    std::sort(removed.begin(), removed.end());
    ASSERT_EQ(removed, expected) << end - order.begin() << " left";
    end -= count;
  }
  EXPECT_TRUE(greedy.next().empty());
}

TEST(Decimation, EveryStepIsTheGreedyChoice) {
  for (const auto& [width, height] : kSizes)
    for (const Relief relief : kReliefs) {
      SCOPED_TRACE(testing::Message()
                   << width << " x " << height << ", relief " << static_cast<int>(relief));
      expectGreedyChoices(Terrain(width, height, relief));
    }
}

TEST(Decimation, EveryStepIsTheGreedyChoiceWhateverTheOverhang) {
  for (uint32_t width = 2; width <= 12; ++width)
    for (uint32_t height = 2; height <= 9; ++height) {
      SCOPED_TRACE(testing::Message() << width << " x " << height);
      expectGreedyChoices(Terrain(width, height, Relief::kNoise));
    }
}

/// Between them the numbers of levels that are kept up to date tell every slope late or at once.
TEST(Decimation, OrderDoesNotDependOnWhenSlopesAreSummedUp) {
  for (const auto& [width, height] : {std::pair{70u, 50u}, {129u, 65u}})
    for (const Relief relief : {Relief::kTerrain, Relief::kNoise, Relief::kSteps}) {
      const Terrain terrain(width, height, relief);
      const Lattice lattice = *Lattice::make(width, height);
      const std::vector<double> gains = vertexGains(lattice, terrain.view());
      const VertexCosts costs(lattice);
      const std::vector<VertexId> order = generalDecimation(gains, costs, 20);
      for (const uint32_t prompt_levels : {4u, 8u, 12u})
        EXPECT_EQ(generalDecimation(gains, costs, prompt_levels), order)
            << width << " x " << height << ", " << prompt_levels;
    }
}

TEST(Decimation, OrderHoldsEveryVertexAfterItsParents) {
  const Terrain terrain(61, 38, Relief::kTerrain);
  const Result<MeshSequence> sequence = decimate(terrain.view());
  checks::expectParentsFirst(sequence->lattice(), sequence->order());
}

TEST(Decimation, MeshesOfGrowingBudgetsAreNestedAndNeverWorse) {
  const Terrain terrain(70, 50, Relief::kTerrain);
  const Result<MeshSequence> sequence = decimate(terrain.view());
  LatticeMesh coarser = sequence->mesh(sequence->bestPrefix(0));
  EXPECT_EQ(coarser.triangleCount(), sequence->triangleCount(0));
  double error = sequence->squaredError(0);
  for (const uint32_t budget : {5u, 6u, 7u, 30u, 31u, 100u, 1000u, 4000u, 100000u}) {
    const LatticeMesh mesh = sequence->mesh(sequence->bestPrefix(budget));
    EXPECT_LE(mesh.triangleCount(), std::max(budget, sequence->triangleCount(0)));
    ASSERT_GE(mesh.vertices.size(), coarser.vertices.size());
    EXPECT_TRUE(
        std::equal(coarser.vertices.begin(), coarser.vertices.end(), mesh.vertices.begin()));
    EXPECT_LE(sequence->squaredError(sequence->bestPrefix(budget)), error);
    error = sequence->squaredError(sequence->bestPrefix(budget));
    coarser = mesh;
  }
  EXPECT_EQ(error, 0);
}

TEST(Decimation, PlanesNeedTheRootsOnly) {
  const Terrain terrain(45, 71, Relief::kPlane);
  const Result<MeshSequence> sequence = decimate(terrain.view());
  EXPECT_EQ(sequence->squaredError(0), 0);
  EXPECT_EQ(sequence->bestPrefix(1000000), 0u);
}

/// The published orders: no compiler, optimisation level or machine may change them.
TEST(Decimation, OrderIsTheSameEverywhere) {
  const Terrain terrain(70, 50, Relief::kTerrain);
  const auto hashOf = [&](MeshPolicy policy) {
    uint64_t hash = 14695981039346656037u;  // FNV-1a
    const Result<MeshSequence> sequence = decimate(terrain.view(), {policy, {}});
    for (const VertexId v : sequence->order()) hash = (hash ^ v) * 1099511628211u;
    return hash;
  };
  EXPECT_EQ(hashOf(MeshPolicy::kGeneralDecimation), 10712087348571217729u);
  EXPECT_EQ(hashOf(MeshPolicy::kNearHull), 14229587989757422123u);
}

TEST(Decimation, RefusesWhatTheLatticeRefuses) {
  const std::vector<int32_t> heights(5);
  EXPECT_EQ(decimate({1, 5, heights}).status().code(), TKS_USAGE);
}

/// Far above what it takes (tens of milliseconds), far below anything quadratic (minutes).
TEST(Decimation, TakesNoQuadraticTime) {
  for (const Relief relief : kReliefs) {
    const Terrain terrain(300, 200, relief);
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(decimate(terrain.view()).ok());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  }
}

}  // namespace
}  // namespace tetrakis
