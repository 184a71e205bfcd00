// SPDX-License-Identifier: Apache-2.0
// RD decimation against brute force: errors, greedy choices, nested and deterministic orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "codec/decimation.hpp"
#include "codec/gains.hpp"
#include "tests/mesh_checks.hpp"

namespace tetrakis {
namespace {

enum class Relief { kFlat, kPlane, kTerrain, kNoise, kSteps, kExtreme };

/// Integer arithmetic and minstd only: the same heights everywhere.
struct Terrain {
  uint32_t width, height;
  std::vector<int32_t> heights;

  Terrain(uint32_t w, uint32_t h, Relief relief) : width(w), height(h), heights(size_t{w} * h) {
    for (uint32_t y = 0; y < h; ++y)
      for (uint32_t x = 0; x < w; ++x) heights[size_t{y} * w + x] = sample(relief, x, y);
  }
  SurfaceView view() const { return {width, height, heights}; }

 private:
  std::minstd_rand random_{1};

  int32_t sample(Relief relief, uint32_t x, uint32_t y) {
    const auto noise = static_cast<int32_t>(random_() % 2001) - 1000;
    const auto i = static_cast<int32_t>(x), j = static_cast<int32_t>(y);
    switch (relief) {
      case Relief::kFlat:
        return 42;
      case Relief::kPlane:
        return 7 * i - 3 * j + 100;
      case Relief::kTerrain:
        return 5 * i * i - 3 * i * j + 40 * std::abs(3 * i - 5 * j) + noise / 20;
      case Relief::kNoise:
        return noise;
      case Relief::kSteps:
        return (i / 5 + j / 3) % 3 * 1000;
      case Relief::kExtreme:
        return noise < 0 ? std::numeric_limits<int32_t>::min()
                         : std::numeric_limits<int32_t>::max();
    }
    return 0;
  }
};

constexpr std::initializer_list<Relief> kReliefs = {Relief::kFlat,    Relief::kPlane,
                                                    Relief::kTerrain, Relief::kNoise,
                                                    Relief::kSteps,   Relief::kExtreme};
const std::vector<std::pair<uint32_t, uint32_t>> kSizes = {{2, 2},  {2, 9},   {3, 3},  {3, 8},
                                                           {5, 5},  {9, 9},   {6, 6},  {7, 10},
                                                           {11, 6}, {12, 12}, {13, 4}, {10, 19}};

/// Every sample against the triangles that hold it; all of them have to agree on it.
double bruteForceError(const LatticeMesh& mesh, const Terrain& terrain) {
  std::vector<double> surface(terrain.heights.size(), std::nan(""));
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<double, 3> x, y, z;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t sample = mesh.vertices[mesh.triangles[3 * t + k]];
      x[k] = sample % terrain.width;
      y[k] = sample / terrain.width;
      z[k] = terrain.heights[sample];
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    for (size_t i = 0; i < surface.size(); ++i) {
      const double px = static_cast<double>(i % terrain.width) - x[0];
      const double py = static_cast<double>(i / terrain.width) - y[0];
      const double u = (px * (y[2] - y[0]) - py * (x[2] - x[0])) / area;
      const double v = (py * (x[1] - x[0]) - px * (y[1] - y[0])) / area;
      if (u < -1e-12 || v < -1e-12 || u + v > 1 + 1e-12) continue;
      const double plane = z[0] + u * (z[1] - z[0]) + v * (z[2] - z[0]);
      const double scale = std::abs(z[0]) + std::abs(z[1]) + std::abs(z[2]) + 1;
      EXPECT_FALSE(std::abs(surface[i] - plane) > 1e-12 * scale) << "a crack";
      surface[i] = plane;
    }
  }
  double error = 0;
  for (size_t i = 0; i < surface.size(); ++i)
    error += (terrain.heights[i] - surface[i]) * (terrain.heights[i] - surface[i]);
  return error;
}

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
  const Result<MeshSequence> sequence = decimate(terrain.view());
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

TEST(Decimation, OrderHoldsEveryVertexAfterItsParents) {
  const Terrain terrain(61, 38, Relief::kTerrain);
  const Result<MeshSequence> sequence = decimate(terrain.view());
  const Lattice& lattice = sequence->lattice();
  std::vector<bool> inserted(lattice.vertexCount());
  for (const VertexId v : sequence->order()) {
    EXPECT_FALSE(inserted[v]);
    inserted[v] = true;
    lattice.forEachParent(lattice.site(v),
                          [&](Site parent) { EXPECT_TRUE(inserted[lattice.id(parent)]); });
  }
  EXPECT_EQ(sequence->order().size(), lattice.vertexCount());
}

TEST(Decimation, MeshesOfGrowingBudgetsAreNestedAndNeverWorse) {
  const Terrain terrain(70, 50, Relief::kTerrain);
  const Result<MeshSequence> sequence = decimate(terrain.view());
  LatticeMesh coarser = sequence->meshWithAtMost(0);
  EXPECT_EQ(coarser.triangleCount(), sequence->triangleCount(0));
  double error = sequence->squaredError(0);
  for (const uint32_t budget : {5u, 6u, 7u, 30u, 31u, 100u, 1000u, 4000u, 100000u}) {
    const LatticeMesh mesh = sequence->meshWithAtMost(budget);
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

/// The published order: no compiler, optimisation level or machine may change it.
TEST(Decimation, OrderIsTheSameEverywhere) {
  const Terrain terrain(70, 50, Relief::kTerrain);
  uint64_t hash = 14695981039346656037u;  // FNV-1a
  const Result<MeshSequence> sequence = decimate(terrain.view());
  for (const VertexId v : sequence->order()) hash = (hash ^ v) * 1099511628211u;
  EXPECT_EQ(hash, 10712087348571217729u);
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
