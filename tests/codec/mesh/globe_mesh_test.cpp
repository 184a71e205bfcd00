// SPDX-License-Identifier: Apache-2.0
// Meshes round a globe: what is closed, what stays open, and where points lie.
#include "codec/mesh/globe/globe_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include "codec/mesh/globe/bends.hpp"
#include "codec/mesh/globe/globe_places.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/welded_mesh.hpp"

namespace tetrakis::test {
namespace {

using checks::WeldedMesh;
using Place = std::pair<double, double>;

/// A random closed set: ancestors of vertices that are taken with this probability.
std::vector<VertexId> someVertices(const Lattice& lattice, double part, uint32_t seed) {
  std::minstd_rand random(seed);
  std::bernoulli_distribution taken(part);
  std::vector<uint8_t> marks(lattice.sampleCount());
  for (uint8_t& mark : marks) mark = taken(random);
  return codedVertices(lattice, marks);
}

/// A mesh whose vertices are one where they lie on one place of the globe.
WeldedMesh weld(const GlobeMesh& mesh, const RoundGrid& grid) {
  std::vector<Place> places;
  for (const GridPlace& place : mesh.places) {
    const bool pole = place.row == grid.first_pole || place.row == grid.last_pole;
    const double column = pole ? -1 : place.column == grid.width ? 0 : place.column;
    places.emplace_back(column, place.row);
  }
  return checks::weldedMesh(places, mesh.triangles);
}

std::vector<float> heightsOf(const LatticeMesh& mesh) {
  std::vector<float> heights;
  for (const uint32_t sample : mesh.vertices)
    heights.push_back(static_cast<float>(sample * 2654435761u >> 20));
  return heights;
}

/// All samples of the border columns that the mesh has, and all its triangles, are used.
void expectAllThere(const LatticeMesh& mesh, const GlobeMesh& round, const RoundGrid& grid) {
  std::set<Place> places;
  for (const GridPlace& place : round.places) places.emplace(place.column, place.row);
  for (const uint32_t sample : mesh.vertices) {
    const double column = sample % grid.width, row = sample / grid.width;
    if (row == grid.first_pole || row == grid.last_pole) continue;
    ASSERT_TRUE(places.contains({column, row}));
    if (column == 0) {
      ASSERT_TRUE(places.contains({double(grid.width), row}));
    }
  }
}

/// Counter-clockwise on the grid.
void expectOutwards(const GlobeMesh& mesh) {
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const GridPlace a = mesh.places[mesh.triangles[t]], b = mesh.places[mesh.triangles[t + 1]],
                    c = mesh.places[mesh.triangles[t + 2]];
    ASSERT_GT((b.row - a.row) * (c.column - a.column) - (b.column - a.column) * (c.row - a.row), 0);
  }
}

constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{2, 2},  {2, 9},  {3, 2},   {3, 3},   {7, 5},
                                                    {8, 4},  {9, 9},  {16, 33}, {36, 18}, {37, 19},
                                                    {64, 5}, {5, 64}, {96, 48}};

template <class Check>
void forEachMesh(Check&& check) {
  uint32_t seed = 1;
  for (const auto& [width, height] : kSizes) {
    const Result<Lattice> lattice = Lattice::make(width, height);
    ASSERT_TRUE(lattice.ok());
    for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << part);
      check(*lattice, meshOf(*lattice, someVertices(*lattice, part, ++seed)));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(GlobeMesh, IsAClosedSphereWithBothPolesBeyondTheRows) {
  forEachMesh([](const Lattice& lattice, const LatticeMesh& mesh) {
    const RoundGrid grid{lattice.width(), lattice.height(), -0.5, lattice.height() - 0.5};
    const GlobeMesh round = closedRound(mesh, heightsOf(mesh), grid);
    const WeldedMesh welded = weld(round, grid);
    EXPECT_EQ(welded.open, 0u);
    EXPECT_EQ(welded.euler(), 2);
    expectAllThere(mesh, round, grid);
    expectOutwards(round);
  });
}

TEST(GlobeMesh, IsAClosedSphereWithRowsThatArePoles) {
  forEachMesh([](const Lattice& lattice, const LatticeMesh& mesh) {
    // With a row between the poles for every column.
    if (mesh.vertices.size() < lattice.sampleCount() || lattice.height() < 3) return;
    const RoundGrid grid{lattice.width(), lattice.height(), 0, lattice.height() - 1.0};
    const GlobeMesh round = closedRound(mesh, heightsOf(mesh), grid);
    const WeldedMesh welded = weld(round, grid);
    EXPECT_EQ(welded.open, 0u);
    EXPECT_EQ(welded.euler(), 2);
    expectAllThere(mesh, round, grid);
    expectOutwards(round);
  });
}

/// Of the first and of the last row, the fewer.
long verticesAtEnds(const LatticeMesh& mesh, const Lattice& lattice) {
  const auto inRow = [&](uint32_t row) {
    return std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                         [&](uint32_t sample) { return sample / lattice.width() == row; });
  };
  return std::min(inRow(0), inRow(lattice.height() - 1));
}

TEST(GlobeMesh, IsOpenWhereThereIsNoPole) {
  forEachMesh([](const Lattice& lattice, const LatticeMesh& mesh) {
    // Between two vertices the way round looks like the way back.
    if (verticesAtEnds(mesh, lattice) < 3) return;
    const RoundGrid band{lattice.width(), lattice.height()};
    const GlobeMesh round = closedRound(mesh, heightsOf(mesh), band);
    const WeldedMesh welded = weld(round, band);
    EXPECT_EQ(welded.euler(), 0);
    EXPECT_EQ(welded.loops, 2u);
    expectOutwards(round);
    const RoundGrid cap{lattice.width(), lattice.height(), -0.5, {}};
    const WeldedMesh capped = weld(closedRound(mesh, heightsOf(mesh), cap), cap);
    EXPECT_EQ(capped.euler(), 1);
    EXPECT_EQ(capped.loops, 1u);
  });
}

TEST(GlobeMesh, HasThePolesAtTheMeanOfTheirRows) {
  const Result<Lattice> lattice = Lattice::make(9, 5);
  const LatticeMesh mesh = meshOf(*lattice, allVertices(*lattice));
  std::vector<float> heights;
  for (const uint32_t sample : mesh.vertices)
    heights.push_back(sample < 9 ? static_cast<float>(sample) : 100.0f);
  for (const double pole : {-0.5, 0.0}) {
    const RoundGrid grid{9, 5, pole, {}};
    const GlobeMesh round = closedRound(mesh, heights, grid);
    for (size_t v = 0; v < round.places.size(); ++v)
      if (round.places[v].row == pole) {
        EXPECT_EQ(round.heights[v], 4);
      }
  }
}

TEST(GlobeMesh, HasNoTriangleThatTouchesAVoid) {
  const Result<Lattice> lattice = Lattice::make(24, 12);
  const LatticeMesh mesh = meshOf(*lattice, allVertices(*lattice));
  const RoundGrid grid{24, 12, -0.5, 11.5};
  std::minstd_rand random(7);
  for (const int part : {0, 2, 5, 40}) {
    std::vector<float> heights(mesh.vertices.size(), 1);
    for (float& height : heights)
      if (static_cast<int>(random() % 100) < part) height = std::numeric_limits<float>::quiet_NaN();
    const GlobeMesh round = closedRound(mesh, heights, grid);
    for (const float height : round.heights) ASSERT_EQ(height, 1);
    weld(round, grid);
    EXPECT_EQ(round.triangles.size() == 3 * 2 * 24 * 12, part == 0);
  }
  const std::vector<float> none(mesh.vertices.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(closedRound(mesh, none, grid).triangles.empty());
}

TEST(Bends, LeaveTheSurfaceAndLetNoEdgeCutThroughTheGlobe) {
  for (const auto& [columns, rows] : {std::pair{256u, 129u}, {360u, 180u}, {97u, 60u}}) {
    const uint32_t width = columns, height = rows;
    const Result<Lattice> lattice = Lattice::make(width, height);
    for (const double part : {0.0, 0.001, 0.02}) {
      const std::vector<VertexId> inserted = someVertices(*lattice, part, 5);
      LatticeMesh mesh = meshOf(*lattice, inserted);
      // A plane stays one.
      const auto plane = [&](uint32_t sample) {
        return static_cast<float>(sample % width) + 3 * static_cast<float>(sample / width);
      };
      std::vector<float> heights;
      for (const uint32_t sample : mesh.vertices) heights.push_back(plane(sample));
      addBends(*lattice, inserted, bendLevel(*lattice, 0), {}, mesh, heights);
      ASSERT_EQ(heights.size(), mesh.vertices.size());
      // Vertices beyond the border fall onto it, and the edges that they split with them.
      const uint32_t side = lattice->rootSide();
      const bool overhangs = (width - 1) % side != 0 || (height - 1) % side != 0;
      for (size_t v = 0; v < heights.size() && !overhangs; ++v)
        ASSERT_EQ(heights[v], plane(mesh.vertices[v]));
      for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const int64_t a = mesh.vertices[mesh.triangles[i]] % width,
                      b = mesh.vertices[mesh.triangles[next]] % width;
        ASSERT_LE(std::abs(a - b) * 64, width);
      }
    }
  }
}

TEST(Bends, KeepWithinHalfOfTheTriangles) {
  const Result<Lattice> lattice = Lattice::make(1080, 540);
  uint32_t before = 0;
  for (const uint32_t triangles : {1u, 1000u, 5000u, 20000u, 100000u}) {
    const uint32_t level = bendLevel(*lattice, triangles);
    EXPECT_GE(level, before);
    before = level;
    LatticeMesh mesh = meshOf(*lattice, {});
    std::vector<float> heights(mesh.vertices.size());
    addBends(*lattice, {}, level, {}, mesh, heights);
    EXPECT_LE(mesh.triangleCount(), std::max(triangles / 2, 300u));
  }
  EXPECT_EQ(before, bendLevel(*lattice, 0));
}

TEST(GlobePlaces, LieOnTheSphere) {
  const GlobePlaces places({-179, 2, 180}, {89.5, -1, 180}, {1, 1});
  for (double column = 0; column <= 180; column += 0.5) {
    for (double row = -0.5; row < 180; row += 0.5) {
      const auto [x, y, z] = places.at({column, row}, 0);
      ASSERT_NEAR(std::hypot(x, y, z), 1, 1e-15);
      ASSERT_NEAR(std::asin(z), (89.5 - row) * std::acos(-1) / 180, 1e-7);
    }
  }
  for (double row = -0.5; row < 180; row += 0.5)
    ASSERT_EQ(places.at({0, row}, 0.25), places.at({180, row}, 0.25));
  for (double column = 0; column < 180; ++column) {
    ASSERT_EQ(places.at({column, -0.5}, 0.5), (std::array<double, 3>{0, 0, 1.5}));
    ASSERT_EQ(places.at({column, 179.5}, 0.5), (std::array<double, 3>{0, 0, -1.5}));
  }
}

TEST(GlobePlaces, LieOnTheEllipsoidAndAlongItsNormal) {
  const Spheroid earth{6378137.0, 6356752.314245};
  const GlobePlaces places({0, 1, 360}, {90, -0.5, 361}, earth);
  for (double row = 0; row < 361; row += 7) {
    const auto [x, y, z] = places.at({33, row}, 0);
    const double across = std::hypot(x, y) / earth.equatorial, along = z / earth.polar;
    ASSERT_NEAR(across * across + along * along, 1, 1e-14);
    const auto [x2, y2, z2] = places.at({33, row}, 1000);
    // The gradient of the ellipsoid.
    const double gx = x / (earth.equatorial * earth.equatorial),
                 gz = z / (earth.polar * earth.polar);
    ASSERT_NEAR((x2 - x) * gz, (z2 - z) * gx, 1e-11);
    ASSERT_NEAR(std::hypot(x2 - x, y2 - y, z2 - z), 1000, 1e-6);
  }
  // London's meridian at the equator, 90 degrees east, by their definition.
  EXPECT_EQ(places.at({0, 180}, 5), (std::array<double, 3>{6378142, 0, 0}));
  EXPECT_EQ(places.at({90, 180}, 5), (std::array<double, 3>{0, 6378142, 0}));
}

TEST(GlobePlaces, KnowWhichRowsReachThePoles) {
  const auto grid = [](double first, double step, uint32_t rows) {
    return GlobePlaces({0, 1, 360}, {first, step, rows}, {1, 1}).grid();
  };
  EXPECT_EQ(grid(89.5, -1, 180).first_pole, -0.5);
  EXPECT_EQ(grid(89.5, -1, 180).last_pole, 179.5);
  EXPECT_EQ(grid(-90, 1, 181).first_pole, 0);
  EXPECT_EQ(grid(-90, 1, 181).last_pole, 180);
  EXPECT_EQ(grid(89, -1, 179).first_pole, -1);
  EXPECT_FALSE(grid(83.5, -1, 144).first_pole);
  EXPECT_FALSE(grid(83.5, -1, 144).last_pole);
  EXPECT_FALSE(GlobePlaces({0, 1, 360}, {90.5, -1, 181}, {1, 1}).onGlobe());
}

}  // namespace
}  // namespace tetrakis::test
