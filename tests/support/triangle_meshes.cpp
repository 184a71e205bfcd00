// SPDX-License-Identifier: Apache-2.0
#include "tests/support/triangle_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace tetrakis::made {
namespace {

using std::numbers::pi;

/// Two triangles for each cell of a grid of numbers; `wrap` says in which directions it is closed.
std::vector<Triangle> cells(uint32_t width, uint32_t height, bool wrap_x, bool wrap_y) {
  const uint32_t columns = wrap_x ? width : width + 1, rows = wrap_y ? height : height + 1;
  std::vector<Triangle> triangles;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const uint32_t right = (x + 1) % columns, up = (y + 1) % rows;
      const uint32_t a = y * columns + x, b = y * columns + right;
      const uint32_t c = up * columns + right, d = up * columns + x;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

TriangleMesh halved(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.points, {}};
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [place, isnew] = middles.emplace(std::minmax({a, b}), fine.points.size());
    if (isnew) fine.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    return place->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    for (const Triangle& part :
         {Triangle{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}})
      fine.triangles.push_back(part);
  }
  return fine;
}

}  // namespace

TriangleMesh sphere(int levels) {
  TriangleMesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    mesh = halved(mesh);
    for (Point& point : mesh.points) point = (1 / length(point)) * point;
  }
  return mesh;
}

TriangleMesh torus(uint32_t around, uint32_t across) {
  TriangleMesh mesh{{}, cells(around, across, true, true)};
  for (uint32_t y = 0; y < across; ++y) {
    for (uint32_t x = 0; x < around; ++x) {
      const double u = 2 * pi * x / around, v = 2 * pi * y / across, r = 1 + 0.4 * std::cos(v);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  }
  return mesh;
}

TriangleMesh openGrid(uint32_t width, uint32_t height, double bump) {
  TriangleMesh mesh{{}, cells(width, height, false, false)};
  for (uint32_t y = 0; y <= height; ++y) {
    for (uint32_t x = 0; x <= width; ++x) {
      const double u = static_cast<double>(x) / width, v = static_cast<double>(y) / height;
      mesh.points.push_back({u, v, bump * std::sin(5 * u) * std::cos(4 * v + u)});
    }
  }
  return mesh;
}

TriangleMesh sphereWithLimbs(int levels) {
  TriangleMesh mesh = sphere(levels);
  for (Point& point : mesh.points) {
    double radius = 1;
    for (const double x : point) radius += 4 * std::exp(-60 * (1 - std::abs(x)));
    point = radius * point;
  }
  return mesh;
}

TriangleMesh pipe(uint32_t around, uint32_t along) {
  TriangleMesh mesh{{}, cells(around, along, true, false)};
  for (uint32_t y = 0; y <= along; ++y) {
    for (uint32_t x = 0; x < around; ++x) {
      const double u = 2 * pi * x / around, z = static_cast<double>(y) / along;
      const double r = 0.2 + 0.05 * std::sin(6 * z);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), 2 * z});
    }
  }
  return mesh;
}

TriangleMesh moebiusStrip(uint32_t along) {
  TriangleMesh mesh;
  for (uint32_t x = 0; x < along; ++x) {
    const double u = 2 * pi * x / along;
    for (const double v : {-0.3, 0.3}) {
      const double r = 1 + v * std::cos(u / 2);
      mesh.points.push_back({r * std::cos(u), r * std::sin(u), v * std::sin(u / 2)});
    }
    uint32_t c = 2 * x + 2, d = 2 * x + 3;
    if (x + 1 == along) c = 1, d = 0;
    mesh.triangles.push_back({2 * x, c, d});
    mesh.triangles.push_back({2 * x, d, 2 * x + 1});
  }
  return mesh;
}

TriangleMesh soup(std::mt19937& random, uint32_t points, uint32_t count) {
  TriangleMesh mesh;
  const auto coordinate = [&] { return static_cast<double>(random() % 7) - 3; };
  for (uint32_t k = 0; k < points; ++k)
    mesh.points.push_back({coordinate(), coordinate(), coordinate()});
  const auto any = [&] { return static_cast<uint32_t>(random() % points); };
  for (uint32_t k = 0; k < count; ++k) mesh.triangles.push_back({any(), any(), any()});
  return mesh;
}

TriangleMesh beside(const TriangleMesh& a, const TriangleMesh& b, const Point& offset) {
  TriangleMesh both = a;
  const auto first = static_cast<uint32_t>(a.points.size());
  for (const Point& point : b.points) both.points.push_back(point + offset);
  for (const Triangle& t : b.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return both;
}

std::string manifoldFault(const TriangleMesh& mesh) {
  std::set<std::pair<uint32_t, uint32_t>> sides;
  std::vector<std::map<uint32_t, uint32_t>> around(mesh.points.size());  // across each triangle
  for (const Triangle& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (a >= mesh.points.size()) return "no such point " + std::to_string(a);
      if (a == b) return "degenerate at " + std::to_string(a);
      if (!sides.emplace(a, b).second) return "two triangles on one side of an edge";
      around[a][b] = c;
    }
  }
  for (uint32_t point = 0; point < around.size(); ++point) {
    const auto& next = around[point];
    if (next.empty()) return "unused point " + std::to_string(point);
    uint32_t start = next.begin()->first;
    for (const auto& [from, to] : next) {
      if (!sides.contains({from, point})) start = from;  // where an open fan begins
    }
    size_t count = 0;
    for (auto at = next.find(start); at != next.end() && count < next.size(); ++count)
      at = next.find(at->second);
    if (count != next.size()) return "several fans at " + std::to_string(point);
    if (count < 3 && sides.contains({start, point})) return "flat at " + std::to_string(point);
  }
  return {};
}

}  // namespace tetrakis::made
