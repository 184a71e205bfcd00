// SPDX-License-Identifier: Apache-2.0
// Fitted heights against dense normal equations, and decimation that refits.
#include "codec/mesh/fitted_heights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "tests/support/closed_sets.hpp"
#include "tests/support/mesh_checks.hpp"

namespace tetrakis {
namespace {

struct Terrain {
  uint32_t width, height;
  std::vector<int32_t> heights;
  std::vector<uint8_t> known;

  Terrain(uint32_t w, uint32_t h, bool holes = false) : width(w), height(h) {
    std::minstd_rand random(w * 100 + h);
    for (int32_t y = 0; y < static_cast<int32_t>(h); ++y)
      for (int32_t x = 0; x < static_cast<int32_t>(w); ++x) {
        heights.push_back(1000000 + 50 * std::abs(x - y) * (x % 7) - 20 * x * y / 3 +
                          static_cast<int32_t>(random() % 300));
        if (holes) known.push_back(random() % 4 > 0 && (x > 2 || y > 3));
      }
  }
  WeightedSurface surface() const { return {{width, height, heights}, known}; }
  bool counts(size_t sample) const { return known.empty() || known[sample] != 0; }
};

/// The three hats that are not 0 at each sample: (vertex, phi).
using Hats = std::array<std::pair<uint32_t, double>, 3>;

std::vector<Hats> hatsOf(const LatticeMesh& mesh, const Terrain& terrain) {
  std::vector<std::optional<Hats>> hats(terrain.heights.size());
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<double, 3> x, y;
    for (size_t k = 0; k < 3; ++k) {
      x[k] = mesh.vertices[mesh.triangles[3 * t + k]] % terrain.width;
      y[k] = mesh.vertices[mesh.triangles[3 * t + k]] / terrain.width;
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    for (size_t i = 0; i < hats.size(); ++i) {
      const double px = static_cast<double>(i % terrain.width) - x[0];
      const double py = static_cast<double>(i / terrain.width) - y[0];
      const double u = (px * (y[2] - y[0]) - py * (x[2] - x[0])) / area;
      const double v = (py * (x[1] - x[0]) - px * (y[1] - y[0])) / area;
      if (u < -1e-12 || v < -1e-12 || u + v > 1 + 1e-12) continue;
      const uint32_t* corner = &mesh.triangles[3 * t];
      hats[i] = Hats{{{corner[0], 1 - u - v}, {corner[1], u}, {corner[2], v}}};
    }
  }
  std::vector<Hats> all;
  for (const auto& h : hats) all.push_back(h.value());
  return all;
}

std::vector<double> residuals(const FittedMesh& fitted, const std::vector<Hats>& hats,
                              const Terrain& terrain) {
  std::vector<double> r;
  for (size_t i = 0; i < hats.size(); ++i) {
    double z = terrain.counts(i) ? terrain.heights[i] : 0;
    for (const auto& [vertex, phi] : hats[i])
      if (terrain.counts(i)) z -= phi * fitted.heights[vertex];
    r.push_back(z);
  }
  return r;
}

double squaredError(const FittedMesh& fitted, const Terrain& terrain) {
  double error = 0;
  for (const double r : residuals(fitted, hatsOf(fitted.mesh, terrain), terrain)) error += r * r;
  return error;
}

const std::vector<std::pair<uint32_t, uint32_t>> kSizes = {
    {2, 2}, {2, 9}, {3, 8}, {9, 9}, {7, 10}, {12, 12}, {13, 4}, {10, 19}, {17, 17}, {33, 21}};

std::vector<size_t> prefixes(const FittedSequence& sequence) {
  const size_t count = sequence.order().size();
  return {0, count / 40, count / 11, count / 5, count / 2, count};
}

/// At the least squares the residual is orthogonal to every hat.
void expectOrthogonal(const FittedMesh& fitted, const Terrain& terrain) {
  const std::vector<Hats> hats = hatsOf(fitted.mesh, terrain);
  const std::vector<double> r = residuals(fitted, hats, terrain);
  std::vector<double> product(fitted.heights.size()), weight(fitted.heights.size());
  double scale = 1;
  for (size_t i = 0; i < hats.size(); ++i) {
    scale = std::max(scale, std::abs(r[i]));
    for (const auto& [vertex, phi] : hats[i]) {
      product[vertex] += phi * r[i];
      weight[vertex] += terrain.counts(i) ? phi : 0;
    }
  }
  for (size_t k = 0; k < product.size(); ++k)
    EXPECT_NEAR(product[k], 0, 1e-4 * scale * (1 + weight[k])) << "vertex " << k;
}

TEST(FittedHeights, ResidualsAreOrthogonalToEveryHat) {
  for (const auto& [width, height] : kSizes) {
    const Terrain terrain(width, height);
    const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
    ASSERT_TRUE(sequence.ok());
    for (const size_t n : prefixes(*sequence)) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << n << " inserted");
      const FittedMesh fitted = sequence->mesh(n);
      checks::expectConforming(fitted.mesh, width, height);
      ASSERT_EQ(fitted.heights.size(), fitted.mesh.vertices.size());
      expectOrthogonal(fitted, terrain);
    }
  }
}

TEST(FittedHeights, SamplesThatDoNotCountDoNotMatter) {
  for (const auto& [width, height] : kSizes) {
    const Terrain terrain(width, height, true);
    Terrain wild = terrain;
    for (size_t i = 0; i < wild.heights.size(); ++i)
      if (!wild.known[i]) wild.heights[i] += 1000;
    const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
    const auto vertices = std::span(sequence->order()).first(sequence->order().size() / 3);
    std::vector<double> errors;
    for (const Terrain* t : {&terrain, &std::as_const(wild)}) {
      FittedMoments moments(sequence->lattice(), t->surface());
      moments.coarsen(vertices);
      fitHeights(moments);
      FittedMesh fitted{meshOf(sequence->lattice(), vertices), {}};
      for (const uint32_t v : fitted.mesh.vertices) fitted.heights.push_back(moments.height(v));
      errors.push_back(squaredError(fitted, terrain));
    }
    EXPECT_NEAR(errors[0], errors[1], 0.05 * errors[0] + 1) << width << " x " << height;
  }
}

TEST(FittedHeights, WeightsOfTheViewCountLikeUnknownSamples) {
  const Terrain terrain(33, 21, true);
  const std::vector<float> weights(terrain.known.begin(), terrain.known.end());
  const Lattice lattice = *Lattice::make(terrain.width, terrain.height);
  const VertexId seeds[] = {lattice.vertexCount() / 2, lattice.vertexCount() - 9};
  const std::vector<VertexId> vertices = closureOf(lattice, seeds);
  FittedMoments masked(lattice, terrain.surface());
  FittedMoments weighted(lattice, {{terrain.width, terrain.height, terrain.heights, weights}, {}});
  for (FittedMoments* moments : {&masked, &weighted}) {
    moments->coarsen(vertices);
    fitHeights(*moments);
  }
  for (const uint32_t sample : meshOf(lattice, vertices).vertices)
    EXPECT_EQ(masked.height(sample), weighted.height(sample));
}

TEST(FittedHeights, FullResolutionKeepsTheSamples) {
  const Terrain terrain(21, 34);
  const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
  const FittedMesh fitted = sequence->mesh(sequence->order().size());
  for (size_t k = 0; k < fitted.heights.size(); ++k)
    EXPECT_EQ(fitted.heights[k], terrain.heights[fitted.mesh.vertices[k]]);
}

/// The gains of a fitted mesh are what its vertices save with its heights.
TEST(FittedHeights, GainsAddUpToTheError) {
  for (const auto& [width, height] : kSizes) {
    const Terrain terrain(width, height);
    const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
    const Lattice& lattice = sequence->lattice();
    const auto fine = std::span(sequence->order()).first(sequence->order().size() / 2);
    FittedMoments moments(lattice, terrain.surface());
    moments.coarsen(fine);
    fitHeights(moments);
    std::vector<VertexId> vertices(fine.begin(), fine.end());
    std::sort(vertices.begin(), vertices.end());
    const std::vector<double> gains = moments.gains(vertices);
    const auto errorOf = [&](std::span<const VertexId> kept) {
      FittedMesh mesh{meshOf(lattice, kept), {}};
      for (const uint32_t v : mesh.mesh.vertices) mesh.heights.push_back(moments.height(v));
      return squaredError(mesh, terrain);
    };
    const auto coarse = fine.first(fine.size() / 3);
    double expected = errorOf(fine);
    for (const VertexId v : fine.subspan(coarse.size()))
      expected += gains[std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()];
    const double error = errorOf(coarse);
    EXPECT_NEAR(error, expected, 1e-6 * error + 1e-6) << width << " x " << height;
  }
}

TEST(FittedHeights, OrderIsNestedAndEveryVertexFollowsItsParents) {
  const Terrain terrain(61, 38);
  const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
  checks::expectParentsFirst(sequence->lattice(), sequence->order());
}

TEST(FittedHeights, ErrorFallsWithTheBudgetAndBelowThatOfInterpolation) {
  const Terrain terrain(65, 50);
  const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
  const Result<MeshSequence> greedy = decimate(terrain.surface().view);
  double before = std::numeric_limits<double>::infinity();
  for (const uint32_t budget : {0u, 7u, 30u, 100u, 400u, 1000u, 2500u}) {
    const FittedMesh fitted = sequence->mesh(sequence->longestPrefix(budget));
    EXPECT_LE(fitted.mesh.triangleCount(), std::max<size_t>(budget, greedy->triangleCount(0)));
    const double error = squaredError(fitted, terrain);
    EXPECT_LE(error, before * (1 + 1e-9));
    if (budget >= 30) {
      EXPECT_LT(error, 0.95 * greedy->squaredError(greedy->bestPrefix(budget)));
    }
    before = error;
  }
}

/// Fewer stages lead to other meshes, not to worse ones.
TEST(FittedHeights, SequencesForOneMeshAreAsGoodThere) {
  const Terrain terrain(65, 50);
  const Result<FittedSequence> all = FittedSequence::make(terrain.surface());
  for (const uint32_t budget : {2u, 30u, 150u, 600u, 10000u}) {
    const Result<FittedSequence> one = FittedSequence::makeFor(terrain.surface(), budget);
    const FittedMesh mesh = one->mesh(one->longestPrefix(budget));
    checks::expectConforming(mesh.mesh, 65, 50);
    const double error = squaredError(all->mesh(all->longestPrefix(budget)), terrain);
    EXPECT_LE(squaredError(mesh, terrain), 1.03 * error + 1e-9) << budget;
  }
}

TEST(FittedHeights, PlanesStayPlanes) {
  Terrain terrain(45, 71);
  for (size_t i = 0; i < terrain.heights.size(); ++i)
    terrain.heights[i] = 7 * static_cast<int32_t>(i % 45) - 3 * static_cast<int32_t>(i / 45);
  const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
  for (const size_t n : prefixes(*sequence))
    EXPECT_LT(squaredError(sequence->mesh(n), terrain), 1e-12);
}

/// Heights and order: no compiler, optimisation level or machine may change a bit.
TEST(FittedHeights, BitsAreTheSameEverywhere) {
  const Terrain terrain(70, 50);
  const Result<FittedSequence> sequence = FittedSequence::make(terrain.surface());
  uint64_t hash = 14695981039346656037u;  // FNV-1a
  const auto add = [&](uint64_t value) { hash = (hash ^ value) * 1099511628211u; };
  for (const VertexId v : sequence->order()) add(v);
  for (const double h : sequence->mesh(sequence->longestPrefix(500)).heights)
    add(std::bit_cast<uint64_t>(h));
  EXPECT_EQ(hash, 2577011524168997745u);
}

TEST(FittedHeights, RefusesWhatTheLatticeRefuses) {
  const std::vector<int32_t> heights(5);
  EXPECT_EQ(FittedSequence::make({{1, 5, heights}, {}}).status().code(), TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis
