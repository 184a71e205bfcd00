// SPDX-License-Identifier: Apache-2.0
// Quads of all kinds of meshes hold each triangle once, and are as good as their pairs can be.
#include "codec/remesh/pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "codec/remesh/pair_exchange.hpp"
#include "codec/remesh/pair_graph.hpp"
#include "tests/codec/remesh/small_meshes.hpp"

namespace tetrakis {
namespace {

TriangleMesh strip(uint32_t triangles) {
  TriangleMesh mesh;
  for (uint32_t i = 0; i < triangles + 2; ++i) mesh.points.push_back({0.6 * i, i % 2 * 1.0, 0});
  for (uint32_t t = 0; t < triangles; ++t) {
    mesh.triangles.push_back(t % 2 == 0 ? Triangle{t, t + 2, t + 1} : Triangle{t, t + 1, t + 2});
  }
  return mesh;
}

/// Holes and islands: without `removed` of its triangles.
TriangleMesh torn(TriangleMesh mesh, size_t removed, uint32_t seed) {
  std::mt19937 random(seed);
  for (; removed > 0 && !mesh.triangles.empty(); --removed) {
    std::swap(mesh.triangles[below(random, static_cast<uint32_t>(mesh.triangles.size()))],
              mesh.triangles.back());
    mesh.triangles.pop_back();
  }
  return mesh;
}

TriangleMesh together(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  for (const Point& point : other.points) mesh.points.push_back(point + Point{20, 0, 0});
  for (const Triangle& t : other.triangles) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh;
}

std::vector<TriangleMesh> basesToPair() {
  std::vector<TriangleMesh> result{{}, strip(1), strip(2), strip(3), strip(30), strip(31)};
  for (uint32_t seed = 1; seed < 6; ++seed) {
    result.push_back(randomGrid(3 + seed, 4, seed));
    result.push_back(randomTorus(3 + seed, 5, seed));
    for (const size_t removed : {1, 7, 20, 45}) {
      result.push_back(torn(randomGrid(6, 5, seed), removed, seed));
      result.push_back(torn(sphere(1, 1), removed, seed));
    }
  }
  for (int times = 0; times < 4; ++times) result.push_back(sphere(times, 1));
  result.push_back(together(together(strip(5), sphere(1, 2)), torn(randomTorus(8, 7, 9), 11, 9)));
  return result;
}

using QuadSide = std::pair<uint32_t, uint32_t>;

/// How often quads have each side, in its sense.
std::map<QuadSide, int> sidesOf(const PairedMesh& paired) {
  std::map<QuadSide, int> sides;
  for (const Quad& quad : paired.quads) {
    for (size_t k = 0; k < 4; ++k) ++sides[{quad.corners[k], quad.corners[(k + 1) % 4]}];
  }
  return sides;
}

size_t aloneIn(const TriangleMesh& base, const PairedMesh& paired) {
  return 2 * paired.quads.size() - base.triangles.size();
}

size_t openSides(const std::map<QuadSide, int>& sides) {
  return static_cast<size_t>(std::count_if(sides.begin(), sides.end(), [&](const auto& side) {
    return !sides.contains({side.first.second, side.first.first});
  }));
}

TEST(Pairings, HoldEachTriangleOnce) {
  for (const TriangleMesh& base : basesToPair()) {
    const PairedMesh found = paired(base);
    std::vector<double> areas(base.triangles.size());
    ASSERT_EQ(found.mesh.triangles.size(), 2 * found.quads.size());
    ASSERT_EQ(found.mesh.triangles.size(), found.parts.size());
    ASSERT_EQ(found.mesh.points.size(), base.points.size() + aloneIn(base, found));
    for (size_t t = 0; t < found.parts.size(); ++t) {
      const auto& c = found.parts[t].corners;
      const Point part{dot(c[0], cross(c[1], c[2])), 0, 0};  // of the area, and its sense
      areas[found.parts[t].triangle] += part[0];
      EXPECT_GT(part[0], 0);
      for (size_t k = 0; k < 3; ++k) {
        SurfacePoint corner{static_cast<uint32_t>(t), {0, 0, 0}};
        corner.weights[k] = 1;
        const Point point = found.mesh.points[found.mesh.triangles[t][k]];
        EXPECT_LT(length(at(base, onBase(found, corner)) - point), 1e-12);
      }
    }
    for (const double area : areas) EXPECT_EQ(area, 1);
  }
}

TEST(Pairings, AreQuadsWithFourCorners) {
  for (const TriangleMesh& base : basesToPair()) {
    const PairedMesh found = paired(base);
    for (size_t q = 0; q < found.quads.size(); ++q) {
      const auto& [corners, triangles] = found.quads[q];
      EXPECT_EQ(std::set<uint32_t>(corners.begin(), corners.end()).size(), 4U);
      EXPECT_EQ(triangles[0], 2 * q);
      EXPECT_EQ(triangles[1], 2 * q + 1);
      EXPECT_EQ(found.mesh.triangles[triangles[0]], (Triangle{corners[0], corners[1], corners[2]}));
      EXPECT_EQ(found.mesh.triangles[triangles[1]], (Triangle{corners[0], corners[2], corners[3]}));
    }
  }
}

TEST(Pairings, KeepTheBorderAndItsSense) {
  for (const TriangleMesh& base : basesToPair()) {
    const PairedMesh found = paired(base);
    const std::map<QuadSide, int> sides = sidesOf(found);
    for (const auto& [side, count] : sides) EXPECT_EQ(count, 1);
    std::map<QuadSide, int> before;
    for (const Triangle& t : base.triangles) {
      for (size_t k = 0; k < 3; ++k) before[{t[k], t[(k + 1) % 3]}] = 1;
    }
    EXPECT_EQ(openSides(sides), openSides(before) + aloneIn(base, found));
  }
}

TEST(Pairings, LeaveAloneNoMoreThanNeedBe) {
  EXPECT_EQ(aloneIn(strip(1), paired(strip(1))), 1U);
  EXPECT_EQ(aloneIn(strip(2), paired(strip(2))), 0U);
  EXPECT_EQ(aloneIn(strip(31), paired(strip(31))), 1U);
  for (int times = 0; times < 4; ++times) {
    EXPECT_EQ(aloneIn(sphere(times, 1), paired(sphere(times, 1))), 0U);
  }
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh grid = randomGrid(5, 4, seed), torus = randomTorus(5, 4, seed);
    EXPECT_EQ(aloneIn(grid, paired(grid)), 0U);
    EXPECT_EQ(aloneIn(torus, paired(torus)), 0U);
    const TriangleMesh odd = torn(torus, 1, seed);
    EXPECT_EQ(aloneIn(odd, paired(odd)), 1U);
  }
  // A triangle with one on each of its sides: one pair, and two alone.
  const TriangleMesh star{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 0.5, 0}, {0.5, -1, 0}},
                          {{0, 1, 2}, {2, 1, 3}, {0, 2, 4}, {1, 0, 5}}};
  EXPECT_EQ(aloneIn(star, paired(star)), 2U);
}

TEST(Pairings, FindTheSquares) {
  // On a moved grid the diagonals are the longest sides: their pairs are the squares.
  TriangleMesh grid = randomGrid(9, 8, 3);
  for (size_t i = 0; i < grid.points.size(); ++i) {
    grid.points[i][0] = static_cast<double>(i % 10) + 0.1 * grid.points[i][0];
    grid.points[i][1] = static_cast<double>(i / 10) + 0.1 * grid.points[i][1];
  }
  for (const TriangleMesh& base : {grid, randomGrid(9, 8, 3)}) {
    const PairedMesh found = paired(base);
    ASSERT_EQ(found.quads.size(), 72U);
    for (size_t q = 0; q < 72; ++q) {
      EXPECT_EQ(found.parts[2 * q].triangle / 2, found.parts[2 * q + 1].triangle / 2);
    }
  }
}

TEST(Pairings, TakePointsAnywhere) {
  const TriangleMesh torus = randomTorus(9, 8, 1);
  std::mt19937 random(6);
  TriangleMesh wild = torus, line = torus, huge = torus, tiny = torus, one = torus;
  for (Point& point : wild.points) point = randomPoint(random);
  for (Point& point : line.points) point[1] = point[2] = 0;
  for (Point& point : huge.points) point = 1e200 * point;
  for (Point& point : tiny.points) point = 1e-200 * point;
  for (Point& point : one.points) point = {1, 2, 3};
  for (const TriangleMesh& base : {wild, line, huge, tiny, one}) {
    EXPECT_EQ(paired(base).quads.size(), 72U);
  }
}

TEST(Pairings, TakeBadMeshes) {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1}, e{0, 0, -1};
  const TriangleMesh pillow{{a, b, c}, {{0, 1, 2}, {2, 1, 0}}};
  const PairedMesh two = paired(pillow);
  EXPECT_EQ(two.quads.size(), 2U);
  EXPECT_EQ(two.mesh.points.size(), 4U);
  EXPECT_EQ(openSides(sidesOf(two)), 0U);
  const TriangleMesh fan{{a, b, c, d, e}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  EXPECT_EQ(paired(fan).quads.size(), 3U);
  const TriangleMesh moebius{{a, b, c, d, e},
                             {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}}};
  const TriangleMesh doubled{{a, b, c}, {{0, 1, 2}, {0, 1, 2}, {1, 2, 0}}};
  const TriangleMesh points{{a, b}, {{0, 0, 0}, {0, 1, 1}, {1, 1, 0}, {1, 0, 1}}};
  const TriangleMesh flat{{a, a, a, b}, {{0, 1, 2}, {1, 0, 3}}};
  for (const TriangleMesh& base : {moebius, doubled, points, flat, soup(40, 1)}) {
    EXPECT_GE(2 * paired(base).quads.size(), base.triangles.size());
  }
}

/// Any matching without regard to quality.
Matching anyMatching(const PairGraph& graph) {
  std::vector<bool> may_be_alone;
  for (const uint8_t side : graph.halved) may_be_alone.push_back(side < 3);
  Matching matching(graph.neighbours.size(), kNoMate);
  completeMatching(graph.neighbours, may_be_alone, matching);
  return matching;
}

int pointsOfTwoQuads(const PairedMesh& found) {
  std::map<uint32_t, int> starts;
  std::set<uint32_t> border;
  const std::map<QuadSide, int> sides = sidesOf(found);
  for (const auto& [side, count] : sides) {
    ++starts[side.first];
    if (!sides.contains({side.second, side.first})) border.insert({side.first, side.second});
  }
  return static_cast<int>(std::count_if(starts.begin(), starts.end(), [&](const auto& point) {
    return point.second == 2 && !border.contains(point.first);
  }));
}

double quadsBadness(const PairGraph& graph, const Matching& matching) {
  double sum = 0;
  for (uint32_t t = 0; t < matching.size(); ++t) {
    if (matching[t] >= t && matching[t] != kNoMate)
      sum += graph.badness[t][sideTowards(graph, t, matching[t])];
  }
  return sum;
}

/// Of quads and points.
double allBadness(const TriangleMesh& mesh, const PairGraph& graph, const Matching& matching) {
  std::vector<int> twice(mesh.points.size());
  for (uint32_t t = 0; t < matching.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      if (graph.neighbours[t][k] == matching[t]) continue;
      ++twice[mesh.triangles[t][k]];
      ++twice[mesh.triangles[t][(k + 1) % 3]];
    }
  }
  double sum = quadsBadness(graph, matching);
  for (size_t point = 0; point < twice.size(); ++point) {
    if (!graph.at_border[point]) sum += pointBadness(twice[point] / 2);
  }
  return sum;
}

TEST(Pairings, ExchangesMakeQuadsBetterAndLeaveNoMoreAlone) {
  for (const TriangleMesh& base : basesToPair()) {
    const PairGraph graph = pairGraph(base);
    const Matching before = anyMatching(graph);
    Matching after = before;
    exchangePairs(base, graph, after);
    size_t alone_before = 0, alone = 0;
    for (uint32_t t = 0; t < after.size(); ++t) {
      ASSERT_EQ(after[after[t]], t);
      alone += after[t] == t;
      alone_before += before[t] == t;
      EXPECT_TRUE(after[t] != t || graph.halved[t] < 3);
    }
    EXPECT_EQ(alone, alone_before);
    EXPECT_LE(allBadness(base, graph, after), allBadness(base, graph, before) + 1e-9);
  }
  const TriangleMesh grid = randomGrid(20, 20, 1);
  const PairGraph graph = pairGraph(grid);
  Matching matching = anyMatching(graph);
  const double before = quadsBadness(graph, matching);
  exchangePairs(grid, graph, matching);
  EXPECT_LT(quadsBadness(graph, matching), 0.8 * before);
}

TEST(Pairings, AvoidQuadsThatShareTwoSides) {
  int points = 0, two = 0;
  for (const TriangleMesh& base : basesToPair()) {
    const PairedMesh found = paired(base);
    points += static_cast<int>(found.mesh.points.size());
    two += pointsOfTwoQuads(found);
  }
  EXPECT_LT(two, 0.01 * points);
}

TEST(Pairings, OfAFlatSquareAreTheBest) {
  const double square = quadBadness({Point{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_NEAR(square, 0, 1e-12);
  const double lozenge = quadBadness({Point{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {0.5, 1, 0}});
  const double kite = quadBadness({Point{0, 0, 0}, {1, 0, 0}, {2, 2, 0}, {0, 1, 0}});
  const double bent = quadBadness({Point{0, 0, 0}, {1, 0, 0}, {1, 1, 0.4}, {0, 1, 0}});
  const double reflex = quadBadness({Point{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}});
  for (const double other : {lozenge, kite, bent}) {
    EXPECT_GT(other, 0.005);
    EXPECT_LT(other, 0.5);
  }
  EXPECT_GT(reflex, 0.5);
}

TEST(Pairings, AreTheSameQuadsFromEachTriangle) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const Point a = randomPoint(random), b = randomPoint(random), c = randomPoint(random),
                d = randomPoint(random);
    const double badness = quadBadness({a, b, c, d});
    EXPECT_NEAR(badness, quadBadness({c, d, a, b}), 1e-9);
    EXPECT_GE(badness, 0);
  }
}

}  // namespace
}  // namespace tetrakis
