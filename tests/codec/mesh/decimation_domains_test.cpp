// SPDX-License-Identifier: Apache-2.0
// Merging domains against sets of vertices, surfaces of meshes, and the thesis's closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "codec/mesh/decimation/merging_domains.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/decimation_terrain.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

using checks::Relief;
using checks::Terrain;
using Domain = std::set<VertexId>;

/// A surface whose vertices are removed at random, and all of its domains as sets.
class Removal {
 public:
  explicit Removal(const Terrain& terrain, uint32_t prompt_levels = MergingDomains::kPromptLevels)
      : terrain_(terrain),
        lattice_(*Lattice::make(terrain.width, terrain.height)),
        gains_(vertexGains(lattice_, terrain.view())),
        costs_(lattice_),
        domains_(gains_, costs_, prompt_levels) {
    for (VertexId v = 0; v < lattice_.vertexCount(); ++v) remaining_.insert(v);
  }

  const Domain& remaining() const { return remaining_; }
  Worth worth(VertexId v) const { return domains_.worth(v); }

  VertexId anyRemaining() {
    return *std::next(remaining_.begin(), static_cast<ptrdiff_t>(random_() % remaining_.size()));
  }

  Domain domainOf(VertexId v) const {
    Domain domain = {v};
    std::vector<VertexId> next = {v};
    while (!next.empty()) {
      const Site site = lattice_.site(next.back());
      next.pop_back();
      lattice_.forEachChild(site, [&](Site child) {
        const VertexId w = lattice_.id(child);
        if (remaining_.contains(w) && domain.insert(w).second) next.push_back(w);
      });
    }
    return domain;
  }

  Worth sumOver(const Domain& domain) const {
    Worth sum;
    for (const VertexId v : domain)
      sum += Worth{gains_[v], lattice_.triangleCost(lattice_.site(v))};
    return sum;
  }

  /// Removes M_v and returns what was removed.
  Domain remove(VertexId v) {
    const auto removed = domains_.remove(v, [](VertexId) {});
    for (const VertexId w : removed) remaining_.erase(w);
    return Domain(removed.begin(), removed.end());
  }

  LatticeMesh meshWithout(const Domain& domain) const {
    std::vector<VertexId> vertices;
    std::set_difference(remaining_.begin(), remaining_.end(), domain.begin(), domain.end(),
                        std::back_inserter(vertices));
    return meshOf(lattice_, vertices);
  }

  /// Delta D and delta R of removing M_v, from the surfaces and triangles of both meshes.
  void expectWorthOfMeshes(VertexId v) const {
    const LatticeMesh with = meshWithout({}), without = meshWithout(domainOf(v));
    EXPECT_EQ(worth(v).cost, with.triangleCount() - without.triangleCount());
    const double error = bruteForceError(without, terrain_);
    EXPECT_NEAR(worth(v).distortion, error - bruteForceError(with, terrain_), 1e-9 * (1 + error));
  }

 private:
  const Terrain& terrain_;
  const Lattice lattice_;
  const std::vector<double> gains_;
  const VertexCosts costs_;
  MergingDomains domains_;
  Domain remaining_;
  std::minstd_rand random_{7};
};

Domain intersection(const Domain& a, const Domain& b) {
  Domain both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  return both;
}

TEST(MergingDomains, LoseTheirIntersectionsWithWhatIsRemoved) {
  for (const auto& [width, height] : checks::kSizes) {
    const Terrain terrain(width, height, Relief::kNoise);
    Removal removal(terrain);
    while (!removal.remaining().empty()) {
      const VertexId v = removal.anyRemaining();
      const Domain expected = removal.domainOf(v);
      std::map<VertexId, std::pair<Worth, Domain>> before;
      for (const VertexId a : removal.remaining())
        before[a] = {removal.worth(a), intersection(expected, removal.domainOf(a))};
      ASSERT_EQ(removal.remove(v), expected);
      for (const VertexId a : removal.remaining()) {
        SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << v << " removed");
        Worth worth = before[a].first;
        worth -= removal.sumOver(before[a].second);
        ASSERT_EQ(removal.worth(a), worth) << a;
        ASSERT_EQ(worth, removal.sumOver(removal.domainOf(a))) << a;
      }
    }
  }
}

VertexId steepest(const Removal& removal) {
  const auto slope = [&](VertexId v) {
    return slopeOf(removal.worth(v).distortion, removal.worth(v).cost);
  };
  return *std::min_element(removal.remaining().begin(), removal.remaining().end(),
                           [&](VertexId v, VertexId w) { return slope(v) < slope(w); });
}

/// Proposition 5.2: what holds the best domain whole is worth the step that took it, or more. Only
/// domains that overlap it in part can fall below (5.4.2).
TEST(MergingDomains, HoldTheirSlopesWhereTheyHoldTheBestWhole) {
  for (const auto& [width, height] : checks::kSizes) {
    const Terrain terrain(width, height, Relief::kNoise);
    Removal removal(terrain);
    while (!removal.remaining().empty()) {
      const VertexId v = steepest(removal);
      const Worth step = removal.worth(v);
      const Domain domain = removal.domainOf(v);
      Domain above;
      for (const VertexId a : removal.remaining())
        if (!domain.contains(a) && removal.domainOf(a).contains(v)) above.insert(a);
      removal.remove(v);
      for (const VertexId a : above) {
        const Worth rest = removal.worth(a);  // distortion / cost, without a division by 0
        EXPECT_GE(rest.distortion * step.cost, step.distortion * rest.cost) << a << " above " << v;
      }
    }
  }
}

void expectCompleteDomains(uint32_t width, uint32_t height) {
  SCOPED_TRACE(testing::Message() << width << " x " << height);
  const Terrain terrain(width, height, Relief::kNoise);
  const Removal removal(terrain);
  for (const VertexId v : removal.remaining())
    ASSERT_EQ(removal.worth(v), removal.sumOver(removal.domainOf(v))) << v;
}

TEST(MergingDomains, AreCompleteAtFirstWhateverTheOverhang) {
  for (uint32_t width = 2; width <= 20; ++width)
    for (uint32_t height = 2; height <= 20; height += width % 2 == 0 ? 1 : 3)
      expectCompleteDomains(width, height);
  for (const auto& [width, height] : {std::pair{33u, 33u}, {37u, 45u}, {20u, 90u}, {66u, 34u}})
    expectCompleteDomains(width, height);
}

TEST(MergingDomains, AreWorthWhatMeshesWithoutThemLoseAndSave) {
  const std::vector<std::pair<uint32_t, uint32_t>> sizes = {{9, 9}, {12, 12}, {7, 10}};
  for (const auto& [width, height] : sizes) {
    const Terrain terrain(width, height, Relief::kTerrain);
    Removal removal(terrain);
    for (int step = 0; !removal.remaining().empty(); ++step) {
      if (step % 5 == 0)
        for (const VertexId v : removal.remaining()) removal.expectWorthOfMeshes(v);
      if (HasFailure()) return;
      removal.remove(removal.anyRemaining());
    }
  }
}

void expectExact(uint32_t width, uint32_t height, uint32_t prompt_levels) {
  SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << prompt_levels);
  const Terrain terrain(width, height, Relief::kTerrain);
  Removal removal(terrain, prompt_levels);
  for (int step = 0; !removal.remaining().empty(); ++step) {
    if (step % 40 == 0)
      for (int i = 0; i < 40; ++i) {
        const VertexId v = removal.anyRemaining();
        ASSERT_EQ(removal.worth(v), removal.sumOver(removal.domainOf(v)));
      }
    removal.remove(removal.anyRemaining());
  }
}

TEST(MergingDomains, StayExactOnLargerSurfaces) {
  expectExact(45, 70, MergingDomains::kPromptLevels);
  for (const uint32_t prompt_levels : {2u, 4u, 6u}) {
    expectExact(45, 70, prompt_levels);
    expectExact(33, 33, prompt_levels);
    expectExact(66, 34, prompt_levels);
    expectExact(20, 90, prompt_levels);
  }
}

float floatBelow(double slope) {
  return std::nextafter(static_cast<float>(slope), -std::numeric_limits<float>::infinity());
}

/// While the least slope goes, step after step. Returns how many slopes fell below their bounds.
size_t expectFallsReported(const Terrain& terrain, uint32_t prompt_levels) {
  const Lattice lattice = *Lattice::make(terrain.width, terrain.height);
  const std::vector<double> gains = vertexGains(lattice, terrain.view());
  const VertexCosts costs(lattice);
  MergingDomains domains(gains, costs, prompt_levels);
  Domain remaining;
  for (VertexId v = 0; v < lattice.vertexCount(); ++v) remaining.insert(v);
  size_t falls = 0;
  while (!remaining.empty()) {
    std::map<VertexId, float> bounds;
    for (const VertexId v : remaining) {
      bounds[v] = floatBelow(domains.slope(v));
      domains.setBound(v, bounds[v]);
    }
    const VertexId least = *std::min_element(
        remaining.begin(), remaining.end(),
        [&](VertexId a, VertexId b) { return domains.slope(a) < domains.slope(b); });
    Domain reported;
    for (const VertexId v : domains.remove(least, [&](VertexId a) { reported.insert(a); }))
      remaining.erase(v);
    for (const VertexId v : remaining)
      if (domains.slope(v) < static_cast<double>(bounds[v])) {
        EXPECT_TRUE(reported.contains(v));
        ++falls;
      }
  }
  return falls;
}

TEST(MergingDomains, ReportFallsBelowTheirBounds) {
  size_t falls = 0;
  for (const auto& [width, height] : checks::kSizes)
    for (const Relief relief : checks::kReliefs)
      for (const uint32_t prompt_levels : {2u, 4u, MergingDomains::kPromptLevels})
        falls += expectFallsReported(Terrain(width, height, relief), prompt_levels);
  EXPECT_GT(falls, 0u);
}

/// Triangles of a domain far from any border, in a mesh of n = 2 * 4^d triangles.
struct DomainSize {
  size_t before = 0;  ///< |M_v|: triangles of full resolution with a corner in M_v
  size_t after = 0;   ///< |M_v| without M_v: triangles of its support
};

std::array<uint32_t, 3> cornersOf(const LatticeMesh& mesh, size_t triangle) {
  std::array<uint32_t, 3> corners;
  for (size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[mesh.triangles[3 * triangle + k]];
  std::sort(corners.begin(), corners.end());
  return corners;
}

DomainSize sizeOf(const Lattice& lattice, VertexId v) {
  std::vector<bool> inside(lattice.vertexCount());
  inside[v] = true;
  std::vector<VertexId> others;
  for (VertexId w = 0; w < lattice.vertexCount(); ++w) {
    lattice.forEachParent(lattice.site(w), [&](Site parent) {
      if (inside[lattice.id(parent)]) inside[w] = true;
    });
    if (!inside[w]) others.push_back(w);
  }
  std::set<uint32_t> samples;
  for (VertexId w = 0; w < lattice.vertexCount(); ++w)
    if (inside[w]) samples.insert(lattice.gridIndex(lattice.position(lattice.site(w))));
  const LatticeMesh full = meshOf(lattice, allVertices(lattice)), coarse = meshOf(lattice, others);
  DomainSize size;
  std::set<std::array<uint32_t, 3>> finest;
  for (size_t t = 0; t < full.triangleCount(); ++t) {
    const auto corners = cornersOf(full, t);
    finest.insert(corners);
    size.before += std::any_of(corners.begin(), corners.end(),
                               [&](uint32_t c) { return samples.contains(c); });
  }
  for (size_t t = 0; t < coarse.triangleCount(); ++t)
    size.after += !finest.contains(cornersOf(coarse, t));
  return size;
}

/// (3.3): l in 1 ... 2d, log4n = log4(n) = d + 1/2. Terms as printed.
double closedSizeBefore(double l, double n) {
  const double log4n = std::log2(n) / 2, i = 2 * log4n - l;
  if (i <= 4) return i * std::exp2(1 - l) * n;
  const double c1 = std::exp2(std::floor(log4n - (l + 4) / 2)), c2 = std::exp2(-l) * n / 16;
  return 128 * c2 +
         4 * (c2 * (24 - 12 / c1 + 4.0 / 3 / (c1 * c1)) + 8.0 / 3 / c2 * c1 * c1 - 16 * c1);
}

/// (3.4), as printed.
double closedSizeAfter(double l, double n) {
  const double log4n = std::log2(n) / 2, i = 2 * log4n - l;
  if (i <= 4) return std::exp2(1 - l) * n - 2;
  const double c1 = std::exp2(std::floor(log4n - (l + 4) / 2));
  return 32 * (std::exp2(-(l + 4)) * n / c1 + 1.5 * c1) - 16 * (log4n - l / 2) - 18;
}

/// (3.9), the case l = 1 of (3.3). In print three terms have lost a factor: 1 / n, n and n.
double closedSizeBefore(double n) {
  const double log4n = std::log2(n) / 2;
  if (n < 128) return (2 * log4n - 1) * n;
  const double c1 = std::exp2(std::floor(log4n - 2.5));
  return 7 * n + 1024.0 / 3 * c1 * c1 / n - 64 * c1 - 1.5 * n / c1 + n / (6 * c1 * c1);
}

/// (3.10), the case l = 1 of (3.4). The constant is -10; in print it is -26.
double closedSizeAfter(double n) {
  const double log4n = std::log2(n) / 2;
  if (n < 128) return n - 2;
  const double c1 = std::exp2(std::floor(log4n - 2.5));
  return n / c1 + 48 * c1 - 16 * log4n - 10;
}

TEST(MergingDomains, HaveTheSizesOfTheClosedForms) {
  constexpr uint32_t kD = 7;  // 129 x 129 samples
  const Lattice lattice = *Lattice::make((1 << kD) + 1, (1 << kD) + 1);
  const double n = 2 * std::pow(4.0, kD);
  for (uint32_t l = 5; l <= 2 * kD; ++l) {
    const uint32_t step = lattice.plan(l - 1).step;
    const GridPoint inner{64 - step, Lattice::isCentre(l - 1) ? 64 - step : 64};
    const DomainSize size = sizeOf(lattice, lattice.id(lattice.siteAt(l - 1, inner)));
    SCOPED_TRACE(testing::Message() << "l = " << l);
    EXPECT_NEAR(static_cast<double>(size.before), closedSizeBefore(l, n), 1e-6);
    EXPECT_NEAR(static_cast<double>(size.after), closedSizeAfter(l, n), 1e-6);
    if (l % 2 == 1) {  // (3.5), (3.7)
      const double part = n / std::pow(4.0, (l - 1) / 2);
      EXPECT_NEAR(static_cast<double>(size.before), closedSizeBefore(part), 1e-6);
      EXPECT_NEAR(static_cast<double>(size.after), closedSizeAfter(part), 1e-6);
    } else {  // (3.6), (3.8)
      const double part = n / std::pow(4.0, (l - 2) / 2);
      EXPECT_NEAR(static_cast<double>(size.before), closedSizeBefore(2, part), 1e-6);
      EXPECT_NEAR(static_cast<double>(size.after), closedSizeAfter(2, part), 1e-6);
    }
  }
}

/// Proposition 3.2, in sides of the square of v: its half is 2^k units of the octagon, and the
/// support ends one unit beyond the last vertex.
TEST(MergingDomains, FillTheOctagonOfProposition32InTheLimit) {
  for (const uint32_t k : {4u, 8u, 16u, 30u}) {
    const Octagon centre = Octagon::ofMidpoints(0, k), midpoint = Octagon::ofMidpoints(1, k);
    const double half = std::exp2(k), tolerance = 4 / half;
    const auto reach = [half](int64_t units) { return static_cast<double>(units + 1) / half; };
    EXPECT_NEAR(reach(centre.x) / 2, 1.5, tolerance);
    EXPECT_NEAR(reach(centre.y) / 2 / std::sqrt(2.0), std::sqrt(2.0), tolerance);
    // The square of a midpoint stands on a corner: diagonals of the grid are its axes.
    EXPECT_NEAR(reach(midpoint.y) / std::sqrt(2.0) / std::sqrt(2.0), 1.5, tolerance);
    EXPECT_NEAR(reach(midpoint.x) / std::sqrt(2.0), std::sqrt(2.0), tolerance);
  }
}

TEST(MergingDomains, AreOfMeshesOfTheSizesOfTheClosedForms) {
  for (uint32_t d = 1; d <= 8; ++d) {
    const Lattice lattice = *Lattice::make((1u << d) + 1, (1u << d) + 1);
    const double power = std::pow(4.0, d + 1), side = std::exp2(d);
    double centres = 0, midpoints = 0;
    for (uint32_t level = 0; level < lattice.levelCount(); ++level)
      (Lattice::isCentre(level) ? centres : midpoints) +=
          lattice.firstOf(level + 1) - lattice.firstOf(level);
    EXPECT_NEAR(midpoints, power / 6 + 2 * side - 8.0 / 3, 1e-6);  // (3.1)
    EXPECT_NEAR(centres, power / 12 - 1.0 / 3, 1e-6);
    const double n = 2 * side * side;
    const size_t triangles = meshOf(lattice, allVertices(lattice)).triangleCount();
    EXPECT_EQ(static_cast<double>(triangles), n);
    const auto others = static_cast<double>(lattice.sampleCount() - 1);
    EXPECT_NEAR(others / (0.5 + 1 / side), n, 1e-6);  // (3.2)
  }
}

}  // namespace
}  // namespace tetrakis
