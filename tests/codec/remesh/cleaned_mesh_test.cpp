// SPDX-License-Identifier: Apache-2.0
// Whatever triangles come in, what comes out is a manifold that has lost none of their area; and
// manifolds come out as they were.
#include "codec/remesh/cleaned_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "codec/remesh/mesh_topology.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis {
namespace {

void expectSources(const TriangleMesh& input, const CleanedMesh& clean) {
  ASSERT_EQ(clean.sources.size(), clean.mesh.triangles.size());
  for (size_t t = 0; t < clean.sources.size(); ++t) {
    const TriangleSource& source = clean.sources[t];
    ASSERT_LT(source.triangle, input.triangles.size());
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(clean.mesh.points[clean.mesh.triangles[t][k]],
                input.points[input.triangles[source.triangle][source.corners[k]]]);
    }
  }
}

/// How many triangles were turned round.
uint32_t turnedOnes(const CleanedMesh& clean) {
  return static_cast<uint32_t>(std::count_if(
      clean.sources.begin(), clean.sources.end(),
      [](const TriangleSource& source) { return source.corners != TriangleSource{}.corners; }));
}

/// Triangles of three places, each counted once.
size_t distinctTriangles(const TriangleMesh& mesh) {
  std::set<std::set<Point>> distinct;
  for (const Triangle& t : mesh.triangles) {
    const std::set<Point> corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    if (corners.size() == 3) distinct.insert(corners);
  }
  return distinct.size();
}

TEST(CleanedMeshes, AreManifoldsAndKeepEachTriangleOfASoup) {
  std::mt19937 random(1);
  for (uint32_t run = 0; run < 300; ++run) {
    const TriangleMesh input = made::soup(random, 3 + run % 40, run);
    const CleanedMesh clean = cleaned(input);
    ASSERT_EQ(made::manifoldFault(clean.mesh), "") << run;
    expectSources(input, clean);
    EXPECT_EQ(clean.mesh.triangles.size(), distinctTriangles(input));
    EXPECT_EQ(clean.report.degenerate + clean.report.doubled + clean.mesh.triangles.size(), run);
  }
}

TEST(CleanedMeshes, LeaveManifoldsAsTheyAre) {
  for (const TriangleMesh& mesh : {made::sphere(3), made::torus(20, 9), made::openGrid(7, 5),
                                   made::pipe(8, 5), made::sphereWithLimbs(2)}) {
    const CleanedMesh clean = cleaned(mesh);
    expectSources(mesh, clean);
    EXPECT_EQ(clean.mesh.points.size(), mesh.points.size());
    EXPECT_EQ(clean.mesh.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(topologyOf(clean.mesh), topologyOf(mesh));
    EXPECT_EQ(clean.report.cut_edges + turnedOnes(clean), 0u);
  }
}

TEST(CleanedMeshes, CloseWhatPointsOfItsOwnForEachTriangleHaveOpened) {
  const TriangleMesh mesh = made::torus(12, 8);
  TriangleMesh apart;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<uint32_t>(apart.points.size());
    for (const uint32_t point : t) apart.points.push_back(mesh.points[point]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  const CleanedMesh clean = cleaned(apart);
  EXPECT_EQ(topologyOf(clean.mesh), topologyOf(mesh));
  EXPECT_EQ(clean.mesh.points.size(), mesh.points.size());
}

TEST(CleanedMeshes, WeldZerosOfBothSigns) {
  const CleanedMesh clean =
      cleaned({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {1, -0.0, 0}, {0, -1, 0}},
               {{0, 1, 2}, {4, 3, 5}}});
  EXPECT_EQ(clean.mesh.points.size(), 4u);
  EXPECT_EQ(topologyOf(clean.mesh), (Topology{1, 1, 1}));
}

TEST(CleanedMeshes, LookToTheSideOfTheMajority) {
  std::mt19937 random(2);
  const TriangleMesh mesh = made::sphere(3);
  TriangleMesh mixed = mesh;
  uint32_t turned = 0;
  for (Triangle& t : mixed.triangles) {
    if (random() % 3) continue;
    std::swap(t[1], t[2]);
    ++turned;
  }
  const CleanedMesh clean = cleaned(mixed);
  EXPECT_EQ(turnedOnes(clean), turned);
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(areaNormal(clean.mesh, clean.mesh.triangles[t]), areaNormal(mesh, mesh.triangles[t]));
}

TEST(CleanedMeshes, CutAMoebiusStripOnce) {
  const CleanedMesh clean = cleaned(made::moebiusStrip(20));
  EXPECT_EQ(clean.report.cut_edges, 1u);
  EXPECT_EQ(made::manifoldFault(clean.mesh), "");
  EXPECT_EQ(topologyOf(clean.mesh), (Topology{1, 1, 1}));
}

TEST(CleanedMeshes, SeparateThreeSheetsAndConesThatTouch) {
  const CleanedMesh sheets = cleaned({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                                      {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}});
  EXPECT_EQ(sheets.report.cut_edges, 1u);
  EXPECT_EQ(sheets.mesh.points.size(), 9u);
  EXPECT_EQ(topologyOf(sheets.mesh), (Topology{3, 3, 3}));

  const TriangleMesh ball = made::sphere(1);
  const CleanedMesh cones = cleaned(made::beside(ball, ball, {2, 0, 0}));  // one point in common
  EXPECT_EQ(cones.mesh.points.size(), 2 * ball.points.size());
  EXPECT_EQ(topologyOf(cones.mesh), (Topology{2, 0, 4}));
}

/// A wing on an edge of a ball: the wing comes off, and the ball is closed.
TEST(CleanedMeshes, LeaveABallClosedWhereAWingIsCutOff) {
  TriangleMesh mesh = made::sphere(2);
  const Triangle on = mesh.triangles[5];
  mesh.triangles.push_back({on[0], on[1], static_cast<uint32_t>(mesh.points.size())});
  mesh.points.push_back({3, 3, 3});
  const CleanedMesh clean = cleaned(mesh);
  EXPECT_EQ(made::manifoldFault(clean.mesh), "");
  EXPECT_EQ(topologyOf(clean.mesh), (Topology{2, 1, 3}));
}

TEST(CleanedMeshes, DropDoublesAndLines) {
  TriangleMesh mesh = made::torus(9, 7);
  const Triangle first = mesh.triangles[0];
  mesh.triangles.push_back({first[1], first[0], first[2]});
  mesh.triangles.push_back({first[1], first[1], first[2]});
  const CleanedMesh clean = cleaned(mesh);
  EXPECT_EQ(clean.report.doubled, 1u);
  EXPECT_EQ(clean.report.degenerate, 1u);
  EXPECT_EQ(topologyOf(clean.mesh), topologyOf(made::torus(9, 7)));
}

TEST(CleanedMeshes, MayBeEmpty) {
  EXPECT_TRUE(cleaned({}).mesh.triangles.empty());
  EXPECT_TRUE(cleaned({{{1, 2, 3}}, {}}).mesh.points.empty());
  EXPECT_EQ(topologyOf({}), Topology{});
}

TEST(TopologyNumbers, AreTheOnesOfKnownSurfaces) {
  EXPECT_EQ(topologyOf(made::sphere(2)), (Topology{1, 0, 2}));
  EXPECT_EQ(topologyOf(made::torus(9, 7)), (Topology{1, 0, 0}));
  EXPECT_EQ(topologyOf(made::openGrid(4, 3)), (Topology{1, 1, 1}));
  EXPECT_EQ(topologyOf(made::pipe(6, 3)), (Topology{1, 2, 0}));
  EXPECT_EQ(topologyOf(made::beside(made::sphere(1), made::pipe(5, 2), {5, 0, 0})),
            (Topology{2, 2, 2}));
}

}  // namespace
}  // namespace tetrakis
