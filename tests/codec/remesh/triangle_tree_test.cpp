// SPDX-License-Identifier: Apache-2.0
// Trees of triangles find what looking at every triangle finds.
#include "codec/remesh/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/codec/remesh/small_meshes.hpp"

namespace tetrakis {
namespace {

std::optional<NearPlace> closestOfAll(const TriangleMesh& mesh, const Point& point, double bound) {
  std::optional<NearPlace> best;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const NearPlace found = nearestInTriangle(mesh, t, point);
    if (found.distance > bound || (best && found.distance >= best->distance)) continue;
    best = found;
  }
  return best;
}

/// Needles from the tip of a cone, and across the axes.
TriangleMesh needles(uint32_t around) {
  TriangleMesh mesh{{{0.1, 0.2, 0.5}}, {}};
  for (uint32_t k = 0; k < around; ++k) {
    const double angle = 6.283185307179586 * k / around;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0.1 * std::sin(5 * angle)});
    mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % around});
  }
  return mesh;
}

std::vector<TriangleMesh> searchedMeshes() {
  return {{},           needles(900),   soup(1, 1),          soup(2, 2),
          soup(200, 3), sphere(2, 0.7), randomGrid(9, 7, 4), randomTorus(12, 9, 5)};
}

TEST(TriangleTrees, FindTheClosestPlace) {
  std::mt19937 random(7);
  for (const TriangleMesh& mesh : searchedMeshes()) {
    const TriangleTree tree(mesh), of_runs(mesh, 3);
    for (int i = 0; i < 200; ++i) {
      const Point point = (i % 3 + 0.1) * randomPoint(random);
      const double bound = i % 2 == 0 ? uniform(random) : Box::kFar;
      const auto found = tree.closest(point, bound), expected = closestOfAll(mesh, point, bound);
      const auto of_run = of_runs.closest(point, bound);
      ASSERT_EQ(found.has_value(), expected.has_value());
      ASSERT_EQ(of_run.has_value(), expected.has_value());
      if (!found) continue;
      EXPECT_EQ(of_run->place.triangle, expected->place.triangle);
      EXPECT_EQ(found->place.triangle, expected->place.triangle);
      EXPECT_EQ(found->distance, expected->distance);
      EXPECT_EQ(found->distance, length(at(mesh, found->place) - point));
    }
  }
}

TEST(TriangleTrees, NoPlaceOfATriangleIsNearerThanTheNearest) {
  const TriangleMesh mesh = soup(64, 8);
  std::mt19937 random(9);
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Point point = mesh.points[3 * t] + 0.3 * randomPoint(random);
    const NearPlace nearest = nearestInTriangle(mesh, t, point);
    EXPECT_NEAR(nearest.place.weights[0] + nearest.place.weights[1] + nearest.place.weights[2], 1,
                1e-12);
    for (const double weight : nearest.place.weights) EXPECT_GE(weight, 0);
    for (int i = 0; i < 200; ++i) {
      const double u = uniform(random), v = (1 - u) * uniform(random);
      const SurfacePoint place{t, {u, v, 1 - u - v}};
      EXPECT_GE(length(at(mesh, place) - point), nearest.distance - 1e-9);
    }
  }
}

TEST(TriangleTrees, FindAllCrossings) {
  std::mt19937 random(10);
  for (const TriangleMesh& mesh : searchedMeshes()) {
    const TriangleTree tree(mesh), of_runs(mesh, 3);
    for (int i = 0; i < 200; ++i) {
      Line line{randomPoint(random), randomPoint(random), -1, 2};
      if (i % 4 == 0) line.direction = {0, 0, i % 8 == 0 ? 3.0 : -0.5};
      if (i % 5 == 0) line.first = -Box::kFar, line.last = Box::kFar;
      const LineSight sight(line);
      std::map<uint32_t, double> expected, found;
      for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (const auto crossing = sight.crossing(mesh, t)) expected[t] = crossing->t;
      }
      tree.crossings(line, [&](const Crossing& crossing) {
        EXPECT_TRUE(found.emplace(crossing.place.triangle, crossing.t).second);
        const Point point = line.origin + crossing.t * line.direction;
        EXPECT_LE(length(at(mesh, crossing.place) - point), 1e-9);
        const Point normal = areaNormal(mesh, mesh.triangles[crossing.place.triangle]);
        EXPECT_EQ(crossing.outward, dot(normal, line.direction) > 0);
      });
      EXPECT_EQ(found, expected);
      found.clear();
      of_runs.crossings(line, [&](const Crossing& crossing) {
        found.emplace(crossing.place.triangle, crossing.t);
      });
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(TriangleTrees, LinesCrossClosedMeshesInAndOut) {
  const TriangleMesh mesh = sphere(3, 1);
  const TriangleTree tree(mesh);
  std::mt19937 random(11);
  for (int i = 0; i < 1000; ++i) {  // through corners and middles of sides as well
    const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
    const std::array targets{mesh.points[t[0]], 0.5 * (mesh.points[t[0]] + mesh.points[t[1]]),
                             0.5 * randomPoint(random)};
    const Point origin = 0.5 * randomPoint(random);
    int in = 0, out = 0;
    tree.crossings({origin, targets[i % 3] - origin, -Box::kFar, Box::kFar},
                   [&](const Crossing& crossing) { ++(crossing.outward ? out : in); });
    EXPECT_GE(in, 1);
    EXPECT_GE(out, 1);
  }
}

TEST(TriangleTrees, TakeManyTrianglesInOnePlace) {
  TriangleMesh mesh{{{1, 1, 1}, {2, 1, 1}, {1, 3, 1}}, {}};
  for (int i = 0; i < 5000; ++i) mesh.triangles.push_back({0, i % 2 == 0 ? 1U : 0U, 2});
  const TriangleTree tree(mesh);
  EXPECT_EQ(tree.closest({0, 0, 1})->place.triangle, 0U);
  int crossings = 0;
  tree.crossings({{1.1, 1.1, 0}, {0, 0, 1}}, [&](const Crossing&) { ++crossings; });
  EXPECT_EQ(crossings, 2500);
}

TEST(TriangleTrees, SurvivePointsWhoseDistancesGrowWithoutEnd) {
  TriangleMesh mesh;
  double x = 1e-300;
  for (uint32_t i = 0; i < 900; ++i, x *= 4) {
    mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x, x, 0}, {2 * x, 0, 0}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const TriangleTree tree(mesh);
  EXPECT_EQ(tree.closest({0, 0, 0})->place.triangle, 0U);
  const Point& far = mesh.points[1500];
  EXPECT_EQ(tree.closest(far)->distance, 0);
}

}  // namespace
}  // namespace tetrakis
