// SPDX-License-Identifier: Apache-2.0
#include "tests/support/bad_meshes.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::made {
namespace {

class BadMeshMaker {
 public:
  explicit BadMeshMaker(uint32_t seed) : random_(seed) {}

  std::vector<BadMesh> take() {
    addShapes();
    addCrowds();
    addPlaces();
    addTexcoords();
    return std::move(meshes_);
  }

 private:
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  Point anywhere() { return {uniform(), uniform(), uniform()}; }
  void add(std::string name, TriangleMesh mesh) {
    meshes_.push_back({std::move(name), std::move(mesh), {}});
  }

  /// Of so many triangles, each apart from all others.
  TriangleMesh parts(uint32_t count, double size) {
    TriangleMesh mesh;
    for (uint32_t i = 0; i < count; ++i) {
      const Point middle = anywhere();
      for (int k = 0; k < 3; ++k) mesh.points.push_back(middle + size * anywhere());
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
  }

  /// Triangles around one point, or along one edge.
  TriangleMesh fan(uint32_t count, bool along_edge) {
    TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
    for (uint32_t i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count;
      mesh.points.push_back({std::cos(angle), std::sin(angle), 0.1 * uniform()});
      const uint32_t next = 2 + (i + 1) % count;
      mesh.triangles.push_back({0, along_edge ? 1 : 2 + i, along_edge ? 2 + i : next});
    }
    return mesh;
  }

  /// A sphere, moved and scaled, whose points are thrown about by a part of its radius.
  TriangleMesh ball(const Point& stretch, const Point& middle, double noise = 0) {
    TriangleMesh mesh = sphere(2);
    for (Point& point : mesh.points) {
      point = (1 + noise * (uniform() - 0.5)) * point;
      for (size_t axis = 0; axis < 3; ++axis)
        point[axis] = point[axis] * stretch[axis] + middle[axis];
    }
    return mesh;
  }

  void addShapes() {
    add("empty", {});
    add("points alone", {{{0, 0, 0}, {1, 0, 0}}, {}});
    add("one triangle", parts(1, 1));
    add("two triangles apart", parts(2, 1));
    add("a line", {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}});
    add("one place", {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}});
    add("moebius strip", moebiusStrip(3 + below(300)));
    TriangleMesh doubled = sphere(2);
    const std::vector<Triangle> once = doubled.triangles;
    for (const Triangle& t : once) {
      doubled.triangles.push_back({t[1], t[2], t[0]});
      doubled.triangles.push_back({t[1], t[0], t[2]});
    }
    add("faces three times", doubled);
    TriangleMesh turned = torus(24, 12);
    for (Triangle& t : turned.triangles)
      if (random_() % 2 == 0) std::swap(t[0], t[1]);
    add("faces either way", turned);
    TriangleMesh holes = sphere(2);
    std::erase_if(holes.triangles, [&](const Triangle&) { return random_() % 3 == 0; });
    add("more holes than surface", holes);
    const TriangleMesh shell = sphere(2);
    add("a ball within its own", beside(shell, ball({0.5, 0.5, 0.5}, {}), {0, 0, 0}));
    add("a ball on itself", beside(shell, shell, {0, 0, 0}));
  }

  void addCrowds() {
    add("soup of few points", soup(random_, 8 + below(60), 250));
    add("soup of many points", soup(random_, 150, 500));
    add("parts", parts(300, 0.05));
    add("large parts", parts(200, 1));
    add("a fan of many", fan(400, false));
    add("a book of many", fan(200, true));
    add("needles", parts(200, 0));
    for (Point& point : meshes_.back().mesh.points) point[2] *= 1 + 1e-12 * uniform();
    add("a ball of needles", ball({1, 1e-6, 1e6}, {}));
    add("spikes", ball({1, 1, 1}, {}, 1.9));
    TriangleMesh strip = openGrid(400, 1, 0.01);
    for (Point& point : strip.points) point[0] *= 1e4;
    add("a long strip", strip);
  }

  void addPlaces() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
      TriangleMesh mesh = sphere(2);
      mesh.points[random_() % mesh.points.size()][random_() % 3] = value;
      add("a place that is no number", mesh);
    }
    for (const double size : {1e-320, 1e-300, 1e-150, 1e-30, 1e30, 1e150, 1e300, 1.7e308})
      add("a ball of " + std::to_string(std::log10(size)), ball({size, size, size}, {}));
    for (const double far : {1e6, 1e12, 1e17, 1e200})
      add("a ball far away", ball({1, 1, 1}, {far, -far, far}));
    for (const double far : {1e5, 1e15, 1e300}) {
      TriangleMesh mesh = sphere(2);
      mesh.points[5][1] = far;
      add("an outlier", mesh);
    }
  }

  void addTexcoords() {
    constexpr float kFar = 3e38F, kNumber = std::numeric_limits<float>::quiet_NaN();
    for (const std::vector<float>& of :
         {std::vector{0.0F}, {0.5F, 0.2F, 0.9F}, {-1e5F, 0.5F}, {kNumber, 1e30F, -kFar, kFar}}) {
      BadMesh bad{"odd texture coordinates", sphere(2), {}};
      for (size_t i = 0; i < 6 * bad.mesh.triangles.size(); ++i)
        bad.texcoords.push_back(random_() % 4 == 0 ? of[random_() % of.size()]
                                                   : static_cast<float>(2 * uniform() - 0.5));
      meshes_.push_back(std::move(bad));
    }
  }

  std::mt19937 random_;
  std::vector<BadMesh> meshes_;
};

}  // namespace

std::vector<BadMesh> badMeshes(uint32_t seed) {
  return BadMeshMaker(seed).take();
}

}  // namespace tetrakis::made
