// SPDX-License-Identifier: Apache-2.0
// Distances of meshes whose distance is known.
#include "codec/remesh/mesh_distance.hpp"

#include <gtest/gtest.h>

#include "tests/codec/remesh/small_meshes.hpp"

namespace tetrakis {
namespace {

MeshDistance distanceOf(const TriangleMesh& first, const TriangleMesh& second,
                        size_t count = kDistanceSamples) {
  return meshDistance(TriangleTree(first), TriangleTree(second), count);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(MeshDistances, OfSpheresAreTheDifferenceOfTheirRadii) {
  constexpr double kSag = 0.001;  // facets lie below the sphere by that part of the radius
  const std::array<double, 2> radii{1, 1.25};
  const TriangleMesh small = sphere(4, radii[0]), large = sphere(4, radii[1]);
  const MeshDistance found = distanceOf(small, large, 4000);
  for (const OneWayDistance& way : {found.to_second, found.to_first}) {
    EXPECT_NEAR(way.rms, 0.25, 3 * kSag);
    EXPECT_NEAR(way.largest, 0.25, 3 * kSag);
    EXPECT_GE(way.largest, way.rms);
  }
  EXPECT_EQ(found.error, std::max(found.to_second.rms, found.to_first.rms));
  EXPECT_NEAR(found.psnr, 20 * std::log10(diagonal(small) / 0.25), 0.1);
}

TEST(MeshDistances, OfMovedSpheresFollowTheFormula) {
  // From a unit sphere to the same moved by s: | |p - s| - 1 |, whose mean square over the sphere
  // is 2 + s² - 2 m with m = the mean of |p - s| = 1 + s² / 3.
  const TriangleMesh mesh = sphere(4, 1);
  TriangleMesh moved = mesh;
  const double s = 0.3;
  for (Point& point : moved.points) point[0] += s;
  const MeshDistance found = distanceOf(mesh, moved, 10000);
  const double expected = std::sqrt(2 + s * s - 2 * (1 + s * s / 3));
  EXPECT_NEAR(found.to_second.rms, expected, 1e-3);
  EXPECT_NEAR(found.to_first.rms, expected, 1e-3);
  EXPECT_NEAR(found.to_second.largest, s, 2e-3);
}

TEST(MeshDistances, OfAMeshToItselfAreNothing) {
  for (const TriangleMesh& mesh : {sphere(2, 3), randomGrid(5, 5, 1), soup(50, 2)}) {
    const MeshDistance found = distanceOf(mesh, mesh, 1000);
    EXPECT_LT(found.error, 1e-12);
    EXPECT_LT(found.to_second.largest, 1e-12);
    EXPECT_GT(found.psnr, 200);
  }
}

TEST(MeshDistances, SeeWhatOnlyOneMeshHas) {
  TriangleMesh mesh = sphere(3, 1);
  const size_t all = mesh.triangles.size();
  const TriangleMesh whole = mesh;
  mesh.triangles.resize(all / 2);
  const MeshDistance found = distanceOf(whole, mesh, 2000);
  EXPECT_LT(found.to_first.largest, 1e-12);
  EXPECT_GT(found.to_second.rms, 0.1);
  EXPECT_EQ(found.error, found.to_second.rms);
}

TEST(MeshDistances, OfEmptyMeshesAreInfinite) {
  const TriangleMesh mesh = sphere(0, 1);
  EXPECT_EQ(distanceOf(mesh, TriangleMesh{}).error, kInfinity);
  EXPECT_EQ(distanceOf(TriangleMesh{}, mesh).error, kInfinity);
  EXPECT_EQ(distanceOf(TriangleMesh{}, TriangleMesh{}).error, 0);
}

TEST(MeshDistances, EvenPlacesFollowTheArea) {
  const TriangleMesh mesh = randomGrid(6, 5, 3);
  std::vector<double> counts(mesh.triangles.size());
  Point middle{}, expected{};
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const double part = length(areaNormal(mesh, t));
    area += part;
    expected = expected + part / 3 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
  }
  constexpr size_t kCount = 6000;
  for (const SurfacePoint& place : evenPlaces(mesh, kCount)) {
    ++counts[place.triangle];
    for (const double weight : place.weights) EXPECT_GE(weight, 0);
    middle = middle + 1.0 / kCount * at(mesh, place);
  }
  for (size_t t = 0; t < counts.size(); ++t) {
    const double part = length(areaNormal(mesh, mesh.triangles[t])) / area;
    EXPECT_NEAR(counts[t], part * kCount, 1.0);
  }
  EXPECT_LT(length(middle - 1 / area * expected), 0.01);
}

TEST(MeshDistances, DegenerateMeshesHavePlacesToo) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 0, 0}}};
  EXPECT_EQ(evenPlaces(mesh, 10).size(), 10U);
  EXPECT_LT(distanceOf(mesh, mesh, 10).error, 1e-12);
  EXPECT_TRUE(evenPlaces({}, 10).empty());
}

}  // namespace
}  // namespace tetrakis
