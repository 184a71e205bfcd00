// SPDX-License-Identifier: Apache-2.0
// Meshes for the tests of trees, distances and pairs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis {

/// In [0, 1).
inline double uniform(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

inline uint32_t below(std::mt19937& random, uint32_t end) {
  return static_cast<uint32_t>(random() % end);
}

inline Point randomPoint(std::mt19937& random) {
  Point point;
  for (double& coordinate : point) coordinate = 2 * uniform(random) - 1;
  return point;
}

/// Triangles anywhere in a cube; every eighth is degenerate.
inline TriangleMesh soup(uint32_t triangles, uint32_t seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh;
  for (uint32_t t = 0; t < triangles; ++t) {
    const Point middle = randomPoint(random);
    for (int corner = 0; corner < 3; ++corner) {
      mesh.points.push_back(middle + 0.2 * randomPoint(random));
    }
    if (t % 8 == 0) mesh.points[3 * t + 2] = mesh.points[3 * t + t % 16 / 8];
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

/// Twenty triangles, of which each is cut into four `times` times, on the sphere of `radius`.
inline TriangleMesh sphere(int times, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh{
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (; times > 0; --times) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto next = static_cast<uint32_t>(mesh.points.size());
      const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), next);
      if (isNew) mesh.points.push_back(mesh.points[a] + mesh.points[b]);
      return found->second;
    };
    std::vector<Triangle> parts;
    for (const Triangle& t : mesh.triangles) {
      const uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      for (const Triangle& part :
           {Triangle{t[0], a, c}, Triangle{a, t[1], b}, Triangle{c, b, t[2]}, Triangle{a, b, c}}) {
        parts.push_back(part);
      }
    }
    mesh.triangles = parts;
    for (Point& point : mesh.points) point = (1 / length(point)) * point;
  }
  for (Point& point : mesh.points) point = (radius / length(point)) * point;
  return mesh;
}

/// A grid of `columns` x `rows` squares with random diagonals and moved points, of height 0.
inline TriangleMesh randomGrid(uint32_t columns, uint32_t rows, uint32_t seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh;
  for (uint32_t y = 0; y <= rows; ++y) {
    for (uint32_t x = 0; x <= columns; ++x) {
      const Point moved = 0.2 * randomPoint(random);
      mesh.points.push_back({x + moved[0], y + moved[1], 0});
    }
  }
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const uint32_t a = y * (columns + 1) + x, b = a + 1, d = a + columns + 1, c = d + 1;
      if (random() % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return mesh;
}

/// The grid of randomGrid(), glued into a torus.
inline TriangleMesh randomTorus(uint32_t columns, uint32_t rows, uint32_t seed) {
  TriangleMesh mesh = randomGrid(columns, rows, seed);
  constexpr double kTurn = 6.283185307179586;
  const auto turn = [](double part) { return kTurn * (part - std::floor(part)) - kTurn / 2; };
  for (Point& point : mesh.points) {
    const double around = turn(point[0] / columns), along = turn(point[1] / rows);
    const double out = 3 + portable::cos(along);
    point = {out * portable::cos(around), out * portable::sin(around), portable::sin(along)};
  }
  for (Triangle& triangle : mesh.triangles) {
    for (uint32_t& corner : triangle) {
      const uint32_t x = corner % (columns + 1), y = corner / (columns + 1);
      corner = y % rows * (columns + 1) + x % columns;
    }
  }
  return mesh;
}

}  // namespace tetrakis
