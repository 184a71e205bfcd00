// SPDX-License-Identifier: Apache-2.0
// Bases of all counts have the topology of their mesh, and each place of a base has one place on
// the mesh, and each place of the mesh one on the base.
#include "codec/remesh/mapped_decimation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/mesh_topology.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis {
namespace {

struct Named {
  std::string name;
  TriangleMesh mesh;
};

/// Manifolds of many shapes; all of them a few thousand triangles at most.
std::vector<Named> manifolds() {
  std::mt19937 random(3);
  const TriangleMesh limbs = made::sphereWithLimbs(3), torus = made::torus(24, 12);
  std::vector<Named> all{
      {"sphere", made::sphere(4)},
      {"limbs", limbs},
      {"torus", torus},
      {"grid", made::openGrid(20, 15)},
      {"flat grid", made::openGrid(16, 16, 0)},
      {"pipe", made::pipe(12, 20)},
      {"strip", cleaned(made::moebiusStrip(80)).mesh},
      {"both", made::beside(limbs, made::beside(torus, made::pipe(9, 9), {9, 0, 0}), {0, 9, 0})}};
  for (uint32_t k = 0; k < 6; ++k)
    all.push_back({"soup", cleaned(made::soup(random, 20 + 20 * k, 60 + 40 * k)).mesh});
  return all;
}

SurfacePoint anyPlace(std::mt19937& random, uint32_t triangles) {
  std::array<double, 3> weights;
  for (double& weight : weights) weight = static_cast<double>(random() % 1000000 + 1);
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& weight : weights) weight /= sum;
  return {static_cast<uint32_t>(random() % triangles), weights};
}

void expectSound(const TriangleMesh& mesh, const SurfacePoint& place) {
  ASSERT_LT(place.triangle, mesh.triangles.size());
  double sum = 0;
  for (const double weight : place.weights) {
    ASSERT_GE(weight, 0);
    sum += weight;
  }
  ASSERT_NEAR(sum, 1, 1e-12);
}

TEST(MappedDecimations, KeepTopologyAtEveryCount) {
  for (const auto& [name, mesh] : manifolds()) {
    const Topology before = topologyOf(mesh);
    const MappedDecimation decimation(mesh, 0);
    for (auto most = static_cast<uint32_t>(mesh.triangles.size());; most = 4 * most / 5) {
      const DecimatedMesh base = decimation.base(most);
      EXPECT_EQ(made::manifoldFault(base.mesh), "") << name << most;
      EXPECT_EQ(topologyOf(base.mesh), before) << name << most;
      EXPECT_LE(base.mesh.triangles.size(), std::max(most, decimation.fewest()));
      EXPECT_GE(base.mesh.triangles.size() + 1, std::min<size_t>(most, mesh.triangles.size()));
      if (most <= decimation.fewest()) break;
    }
    EXPECT_EQ(decimation.base(0).mesh.triangles.size(), decimation.fewest()) << name;
  }
}

TEST(MappedDecimations, LeaveFewTrianglesOfSmoothSurfaces) {
  const auto left = [](const TriangleMesh& mesh) { return MappedDecimation(mesh, 0).fewest(); };
  EXPECT_LE(left(made::sphere(4)), 8u);
  EXPECT_LE(left(made::torus(24, 12)), 60u);
  EXPECT_LE(left(made::openGrid(20, 15)), 8u);
  EXPECT_EQ(left(made::openGrid(16, 16, 0)), 2u);
  EXPECT_EQ(left(made::openGrid(1, 1)), 2u);
  TriangleMesh needles = made::openGrid(20, 20, 0);
  for (Point& point : needles.points) point[1] *= 1e-12;
  EXPECT_LE(left(needles), 8u);
  EXPECT_LE(left(made::sphereWithLimbs(4)), 80u);
}

TEST(MappedDecimations, StopAtTheWantedCount) {
  EXPECT_EQ(MappedDecimation(made::sphere(4), 100).fewest(), 100u);
  EXPECT_LE(MappedDecimation(made::openGrid(20, 20), 99).fewest(), 99u);
  EXPECT_GE(MappedDecimation(made::openGrid(20, 20), 99).fewest(), 98u);
}

TEST(MappedDecimations, GoOnAsIfMadeForFewer) {
  for (const DecimationAim aim : {DecimationAim::kEven, DecimationAim::kNear}) {
    const TriangleMesh mesh = made::sphere(4);
    const MappedDecimation at_once(mesh, 100, aim);
    MappedDecimation in_steps(mesh, 4000, aim);
    for (const uint32_t fewest : {1500u, 700u, 100u}) {
      in_steps.goOn(fewest);
      EXPECT_LE(in_steps.fewest(), fewest);
    }
    for (const uint32_t count : {3000u, 900u, 100u}) {
      const DecimatedMesh a = at_once.base(count), b = in_steps.base(count);
      EXPECT_EQ(a.mesh.points, b.mesh.points);
      EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
      EXPECT_EQ(a.triangles, b.triangles);
    }
  }
}

TEST(MappedDecimations, CornersLieInTheirPoints) {
  for (const auto& [name, mesh] : manifolds()) {
    const MappedDecimation decimation(mesh, 0);
    const DecimatedMesh base = decimation.base(static_cast<uint32_t>(mesh.triangles.size() / 8));
    for (uint32_t t = 0; t < base.mesh.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        SurfacePoint corner{t, {0, 0, 0}};
        corner.weights[k] = 1;
        const SurfacePoint place = decimation.toInput(base, corner);
        const Triangle& there = mesh.triangles[place.triangle];
        const auto one = std::find(place.weights.begin(), place.weights.end(), 1.0);
        ASSERT_NE(one, place.weights.end()) << name;
        EXPECT_EQ(mesh.points[there[static_cast<size_t>(one - place.weights.begin())]],
                  base.mesh.points[base.mesh.triangles[t][k]])
            << name;
      }
    }
  }
}

/// Places on side k of a triangle, from the end with the lower number of a point to the other one.
std::vector<Point> alongSide(const TriangleMesh& mesh, const MappedDecimation& decimation,
                             const DecimatedMesh& base, uint32_t triangle, size_t k) {
  size_t from = k, to = (k + 1) % 3;
  const Triangle& corners = base.mesh.triangles[triangle];
  if (corners[from] > corners[to]) std::swap(from, to);
  std::vector<Point> places;
  for (uint32_t step = 0; step <= 24; ++step) {
    SurfacePoint place{triangle, {0, 0, 0}};
    place.weights[to] = step / 24.0;
    place.weights[from] = 1 - place.weights[to];
    const SurfacePoint there = decimation.toInput(base, place);
    expectSound(mesh, there);
    places.push_back(at(mesh, there));
  }
  return places;
}

double farthest(const std::vector<Point>& a, const std::vector<Point>& b) {
  double distance = 0;
  for (size_t k = 0; k < a.size(); ++k) distance = std::max(distance, length(a[k] - b[k]));
  return distance;
}

/// However bad the mesh and steep the map: both sides of an edge do the same arithmetic.
TEST(MappedDecimations, PlacesOnEdgesAreTheSameFromBothSides) {
  for (const auto& [name, mesh] : manifolds()) {
    const MappedDecimation decimation(mesh, 0);
    size_t shared = 0;
    for (const uint32_t most : {400u, 100u, 0u}) {
      const DecimatedMesh base = decimation.base(most);
      std::map<std::pair<uint32_t, uint32_t>, std::vector<Point>> edges;
      for (uint32_t t = 0; t < base.mesh.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
          const Triangle& corners = base.mesh.triangles[t];
          const std::vector<Point> places = alongSide(mesh, decimation, base, t, k);
          const auto [edge, first] =
              edges.emplace(std::minmax({corners[k], corners[(k + 1) % 3]}), places);
          EXPECT_LE(farthest(edge->second, places), 1e-9 * diagonal(mesh)) << name;
          shared += !first;
        }
      }
    }
    EXPECT_GT(shared, 0u) << name;
  }
}

TEST(MappedDecimations, EachTriangleOfTheMeshIsHit) {
  std::mt19937 random(4);
  for (const TriangleMesh& mesh : {made::sphere(3), made::torus(20, 10), made::openGrid(12, 12),
                                   made::sphereWithLimbs(2), made::pipe(8, 16)}) {
    const MappedDecimation decimation(mesh, 60);
    const DecimatedMesh base = decimation.base(60);
    std::vector<uint32_t> hits(mesh.triangles.size());
    for (uint32_t k = 0; k < 100 * mesh.triangles.size(); ++k) {
      const SurfacePoint there = decimation.toInput(
          base, anyPlace(random, static_cast<uint32_t>(base.mesh.triangles.size())));
      expectSound(mesh, there);
      ++hits[there.triangle];
    }
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 0u), 0);
  }
}

/// A fine lattice on each triangle of a base of the flat square lands on the square: its small
/// triangles tile it, and none lies upside down.
TEST(MappedDecimations, ImagesOfSmallTrianglesTileTheMesh) {
  const TriangleMesh mesh = made::openGrid(16, 16, 0);
  constexpr uint32_t kParts = 40;
  for (const uint32_t most : {200u, 50u, 2u}) {
    const MappedDecimation decimation(mesh, most);
    const DecimatedMesh base = decimation.base(most);
    double area = 0, wrong = 0;
    for (uint32_t t = 0; t < base.mesh.triangles.size(); ++t) {
      const auto place = [&](uint32_t x, uint32_t y) {
        return at(mesh, decimation.toInput(base, {t,
                                                  {static_cast<double>(kParts - x - y) / kParts,
                                                   static_cast<double>(x) / kParts,
                                                   static_cast<double>(y) / kParts}}));
      };
      const auto add = [&](const Point& a, const Point& b, const Point& c) {
        const double part = cross(b - a, c - a)[2] / 2;
        area += part;
        wrong += std::max(0.0, -part);
      };
      for (uint32_t y = 0; y < kParts; ++y) {
        for (uint32_t x = 0; x + y < kParts; ++x) {
          add(place(x, y), place(x + 1, y), place(x, y + 1));
          if (x + y + 1 < kParts) add(place(x + 1, y), place(x + 1, y + 1), place(x, y + 1));
        }
      }
    }
    EXPECT_NEAR(area, 1, 1e-9) << most;
    EXPECT_LE(wrong, 1e-3) << most;
  }
}

TEST(MappedDecimations, AreTheSameEachTimeAndInEachUnit) {
  const TriangleMesh mesh = made::sphereWithLimbs(4);
  TriangleMesh large = mesh;
  for (Point& point : large.points) point = 4096.0 * point;
  const MappedDecimation first(mesh, 100), again(mesh, 100), scaled(large, 100);
  const DecimatedMesh base = first.base(300), same = again.base(300), other = scaled.base(300);
  EXPECT_EQ(base.mesh.points, same.mesh.points);
  EXPECT_EQ(base.mesh.triangles, same.mesh.triangles);
  for (size_t k = 0; k < base.mesh.points.size(); ++k)
    EXPECT_EQ(4096.0 * base.mesh.points[k], other.mesh.points[k]);
  EXPECT_EQ(base.mesh.triangles, other.mesh.triangles);
  std::mt19937 random(5);
  for (int k = 0; k < 1000; ++k) {
    const SurfacePoint place = anyPlace(random, 300);
    EXPECT_EQ(first.toInput(base, place).weights, again.toInput(same, place).weights);
  }
}

TEST(MappedDecimations, BearPointsOfManyNeighboursAndHugeCoordinates) {
  TriangleMesh cone{{{0, 0, 1e300}}, {}};
  constexpr uint32_t kAround = 3000;
  for (uint32_t k = 0; k < kAround; ++k) {
    const double angle = 6.283185307179586 * k / kAround;
    cone.points.push_back({1e300 * std::cos(angle), 1e300 * std::sin(angle), -1e300});
    cone.triangles.push_back({0, 1 + k, 1 + (k + 1) % kAround});
  }
  const MappedDecimation decimation(cone, 0);
  EXPECT_LE(decimation.fewest(), 8u);
  EXPECT_EQ(topologyOf(decimation.base(0).mesh), (Topology{1, 1, 1}));
}

TEST(MappedDecimations, BearMeshesWithoutTrianglesOrArea) {
  EXPECT_EQ(MappedDecimation({}, 0).fewest(), 0u);
  TriangleMesh line = made::openGrid(10, 10);
  for (Point& point : line.points) point = {point[0] + 7 * point[1], 0, 0};
  const MappedDecimation decimation(line, 0);
  const DecimatedMesh base = decimation.base(0);
  EXPECT_EQ(topologyOf(base.mesh), (Topology{1, 1, 1}));
  expectSound(line, decimation.toInput(base, {0, {0.5, 0.25, 0.25}}));
}

}  // namespace
}  // namespace tetrakis
