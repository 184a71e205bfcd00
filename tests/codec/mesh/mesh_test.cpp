// SPDX-License-Identifier: Apache-2.0
// The 4-8 lattice and its meshes: neighbours, closures, conformity on grids of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "codec/mesh/topology/ancestors.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/closed_sets.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

using Size = std::pair<uint32_t, uint32_t>;

Lattice latticeOf(Size size) {
  return std::move(*Lattice::make(size.first, size.second));
}

class EverySize : public testing::TestWithParam<Size> {
 protected:
  const Lattice lattice_ = latticeOf(GetParam());

  void expectConforming(const LatticeMesh& mesh) const {
    checks::expectConforming(mesh, lattice_.width(), lattice_.height());
  }
  /// Every vertex with the given chance, and its ancestors.
  std::vector<VertexId> randomClosedSet(double chance, uint32_t seed) const {
    std::mt19937 random(seed);
    std::bernoulli_distribution choose(chance);
    std::vector<VertexId> chosen;
    for (VertexId v = 0; v < lattice_.vertexCount(); ++v)
      if (choose(random)) chosen.push_back(v);
    return closureOf(lattice_, chosen);
  }
  size_t baseTriangles() const { return size_t{2} * lattice_.rootColumns() * lattice_.rootRows(); }
};

INSTANTIATE_TEST_SUITE_P(Sizes, EverySize,
                         testing::Values(Size{2, 2}, Size{2, 9}, Size{9, 2}, Size{3, 3},
                                         Size{3, 1000}, Size{5, 5}, Size{6, 6}, Size{4, 7},
                                         Size{8, 8}, Size{13, 11}, Size{17, 31}, Size{33, 65},
                                         Size{65, 66}, Size{22, 150}, Size{300, 200}));

TEST_P(EverySize, VerticesAreNumberedWithoutGaps) {
  VertexId next = 0;
  for (uint32_t level = 0; level < lattice_.levelCount(); ++level) {
    EXPECT_EQ(lattice_.firstOf(level), next);
    for (; next < lattice_.firstOf(level + 1); ++next) {
      const Site site = lattice_.site(next);
      ASSERT_EQ(site.level, level);
      ASSERT_EQ(lattice_.id(site), next);
      ASSERT_EQ(lattice_.siteAt(level, lattice_.position(site)), site);
    }
  }
  EXPECT_EQ(next, lattice_.vertexCount());
}

TEST_P(EverySize, EverySampleIsARootOrOneVertex) {
  std::vector<int> uses(lattice_.sampleCount());
  for (const uint32_t root : meshOf(lattice_, {}).vertices) ++uses[root];
  for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
    const Site site = lattice_.site(v);
    if (!lattice_.hidden(site)) ++uses[lattice_.gridIndex(lattice_.position(site))];
  }
  EXPECT_EQ(uses, std::vector<int>(uses.size(), 1));
}

TEST_P(EverySize, ChildrenAreTheVerticesWhoseParentOneIs) {
  std::vector<std::pair<VertexId, VertexId>> down, up;
  for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
    const Site site = lattice_.site(v);
    lattice_.forEachChild(site, [&](Site child) { down.emplace_back(v, lattice_.id(child)); });
    size_t parents = 0;
    lattice_.forEachParent(site, [&](Site parent) {
      ASSERT_EQ(parent.level + 1, site.level);
      up.emplace_back(lattice_.id(parent), v);
      ++parents;
    });
    ASSERT_EQ(parents > 0, site.level > 0);
    ASSERT_LE(parents, 2u);
  }
  std::sort(down.begin(), down.end());
  std::sort(up.begin(), up.end());
  EXPECT_EQ(down, up);
}

TEST_P(EverySize, AncestorsAreTheClosureOfParents) {
  const VertexId stride = lattice_.vertexCount() / 500 + 1;
  for (VertexId v = 0; v < lattice_.vertexCount(); v += stride) {
    std::vector<VertexId> walked;
    forEachAncestor(lattice_, lattice_.site(v), [&](VertexId a) { walked.push_back(a); });
    walked.push_back(v);
    std::sort(walked.begin(), walked.end());
    ASSERT_EQ(walked, closureOf(lattice_, std::span(&v, 1)));
  }
}

TEST_P(EverySize, AncestorSumsAddUpWhatDescendantsAdd) {
  std::vector<uint64_t> direct(lattice_.vertexCount()), summed(lattice_.vertexCount());
  AncestorSums<uint64_t> sums(lattice_);
  const auto add = [&](VertexId a, uint64_t amount) { summed[a] += amount; };
  std::mt19937 random(3);
  for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
    const uint64_t amount = random() % 1000;
    forEachAncestor(lattice_, lattice_.site(v), [&](VertexId a) { direct[a] += amount; });
    sums.add(lattice_.site(v), amount, add);
  }
  sums.flush(add);
  EXPECT_EQ(summed, direct);
}

TEST_P(EverySize, FullMeshHasEverySampleAndAllUnitTriangles) {
  const LatticeMesh mesh = meshOf(lattice_, allVertices(lattice_));
  EXPECT_EQ(mesh.vertices.size(), lattice_.sampleCount());
  EXPECT_EQ(mesh.triangleCount(), size_t{2} * (lattice_.width() - 1) * (lattice_.height() - 1));
  expectConforming(mesh);
}

TEST_P(EverySize, RootsAloneCoverTheGrid) {
  const LatticeMesh mesh = meshOf(lattice_, {});
  EXPECT_EQ(mesh.triangleCount(), baseTriangles());
  expectConforming(mesh);
}

TEST_P(EverySize, RandomClosedSetsConform) {
  uint32_t seed = 1;
  for (const double chance : {0.001, 0.01, 0.03, 0.1, 0.3}) {
    const std::vector<VertexId> set = randomClosedSet(chance, seed++);
    const LatticeMesh mesh = meshOf(lattice_, set);
    expectConforming(mesh);
    size_t triangles = baseTriangles();
    for (const VertexId v : set) triangles += lattice_.triangleCost(lattice_.site(v));
    EXPECT_EQ(mesh.triangleCount(), triangles);
  }
}

TEST_P(EverySize, CodedMeshHoldsTheMarkedSamplesAndTheirClosureOnly) {
  std::mt19937 random(7);
  std::vector<uint8_t> marks(lattice_.sampleCount());
  std::vector<VertexId> marked;
  for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
    const Site site = lattice_.site(v);
    if (lattice_.hidden(site) || random() % 50 != 0) continue;
    marks[lattice_.gridIndex(lattice_.position(site))] = 1;
    marked.push_back(v);
  }
  const LatticeMesh mesh = codedMesh(lattice_, marks);
  expectConforming(mesh);
  const LatticeMesh expected = meshOf(lattice_, closureOf(lattice_, marked));
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.triangles, expected.triangles);
  std::vector<bool> present(marks.size());
  for (const uint32_t sample : mesh.vertices) present[sample] = true;
  for (size_t sample = 0; sample < marks.size(); ++sample)
    ASSERT_TRUE(present[sample] || marks[sample] == 0);
}

TEST(Lattice, EveryClosureOfOneVertexConformsOnAllSmallGrids) {
  for (uint32_t width = 2; width <= 14; ++width)
    for (uint32_t height = 2; height <= 14; ++height) {
      const Lattice lattice = latticeOf({width, height});
      for (VertexId v = 0; v < lattice.vertexCount(); ++v) {
        SCOPED_TRACE(testing::Message() << width << " x " << height << ", vertex " << v);
        const std::vector<VertexId> set = closureOf(lattice, std::span(&v, 1));
        checks::expectConforming(meshOf(lattice, set), width, height);
        if (testing::Test::HasFailure()) return;
      }
    }
}

TEST(Lattice, OverhangTakesNoMemory) {
  const Lattice lattice = latticeOf({1026, 1026});
  EXPECT_EQ(lattice.rootSide(), 2048u);
  EXPECT_LT(lattice.vertexCount(), lattice.sampleCount() + 10 * 1026);
}

TEST(Lattice, RefusesSizesWithoutAMeshOrBeyondThirtyTwoBits) {
  EXPECT_EQ(Lattice::make(1, 5).status().code(), TKS_USAGE);
  EXPECT_EQ(Lattice::make(5, 0).status().code(), TKS_USAGE);
  EXPECT_EQ(Lattice::make(1u << 31, 2).status().code(), TKS_LIMIT);
  EXPECT_EQ(Lattice::make(4294967295u, 4294967295u).status().code(), TKS_LIMIT);
  EXPECT_TRUE(Lattice::make(1u << 30, 2).ok());
}

}  // namespace
}  // namespace tetrakis
