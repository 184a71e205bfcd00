// SPDX-License-Identifier: Apache-2.0
// Meshes of fewer triangles than were coded: they have no more than asked for, the same surface
// wherever that suffices, and nothing that the coded mesh has not.
#include "codec/trianglemesh/fewer_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/half_edges.hpp"
#include "codec/remesh/mesh_distance.hpp"
#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/triangle_encoder.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::test {
namespace {

using Corners = std::array<std::array<float, 2>, 3>;

CodedTriangles coded(const TriangleMesh& given, const std::vector<Corners>& texcoords = {},
                     uint32_t places = 4096) {
  const TriangleMesh mesh = texcoords.empty() ? cleaned(given).mesh : given;
  const PlainMesh plain{mesh.points, mesh.triangles, gluedSides(mesh.triangles).opposite,
                        texcoords};
  Result<CodedTriangles> decoded = decodeTriangles(TriangleEncoder(plain, 12).encode(places));
  EXPECT_TRUE(decoded.ok());
  return *std::move(decoded);
}

TriangleMesh inSpace(const CodedTriangles& mesh) {
  TriangleMesh out;
  for (const Place& place : mesh.places)
    out.points.push_back({double(place[0]), double(place[1]), double(place[2])});
  for (size_t t = 0; t < mesh.vertices.size(); t += 3)
    out.triangles.push_back({mesh.vertices[t], mesh.vertices[t + 1], mesh.vertices[t + 2]});
  return out;
}

size_t trianglesOf(const CodedTriangles& mesh) {
  return mesh.vertices.size() / 3;
}

/// What collapses may not change.
struct Surface {
  int64_t euler = 0;
  size_t pieces = 0, borders = 0;
  bool operator==(const Surface&) const = default;
};

size_t loopsOfBorders(const CodedTriangles& mesh) {
  std::set<uint32_t> open;
  for (uint32_t side = 0; side < mesh.sides.size(); ++side)
    if (mesh.sides[side] == kBorder) open.insert(side);
  size_t loops = 0;
  for (; !open.empty(); ++loops) {
    for (uint32_t side = *open.begin(); open.erase(side) > 0;) {
      side = after(side);
      while (mesh.sides[side] != kBorder) side = after(mesh.sides[side]);
    }
  }
  return loops;
}

Surface surfaceOf(const CodedTriangles& mesh) {
  std::vector<uint32_t> waiting;
  std::vector<bool> seen(trianglesOf(mesh));
  Surface surface;
  for (uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    ++surface.pieces;
    seen[first] = true;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const uint32_t t = waiting.back();
      waiting.pop_back();
      for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
        const uint32_t other = mesh.sides[side];
        if (other == kBorder || seen[other / 3]) continue;
        seen[other / 3] = true;
        waiting.push_back(other / 3);
      }
    }
  }
  int64_t twice = 0;
  for (const uint32_t side : mesh.sides) twice += side == kBorder ? 2 : 1;
  surface.borders = loopsOfBorders(mesh);
  surface.euler = static_cast<int64_t>(mesh.places.size() + seen.size()) - twice / 2;
  return surface;
}

using Vertex = std::array<int32_t, 5>;  ///< a place and a texcoord

std::set<Vertex> verticesOf(const CodedTriangles& mesh) {
  std::set<Vertex> all;
  for (size_t corner = 0; corner < mesh.vertices.size(); ++corner) {
    const Place& at = mesh.places[mesh.vertices[corner]];
    const Texcoord on = mesh.wedges.empty() ? Texcoord{} : mesh.texcoords[mesh.wedges[corner]];
    all.insert({at[0], at[1], at[2], on[0], on[1]});
  }
  return all;
}

bool isNumberedByUse(const std::vector<uint32_t>& numbers, size_t count) {
  uint32_t next = 0;
  for (const uint32_t number : numbers) {
    if (number > next) return false;
    next += number == next ? 1 : 0;
  }
  return next == count;
}

/// What every mesh is, however few triangles were asked for.
void expectSound(const CodedTriangles& whole, const CodedTriangles& few, uint64_t most) {
  EXPECT_LE(trianglesOf(few), most);
  EXPECT_GT(trianglesOf(few), 0u);
  EXPECT_TRUE(isNumberedByUse(few.vertices, few.places.size()));
  EXPECT_TRUE(isNumberedByUse(few.wedges, few.texcoords.size()));
  EXPECT_EQ(few.wedges.size(), whole.wedges.empty() ? 0 : few.vertices.size());
  ASSERT_EQ(few.sides.size(), few.vertices.size());
  for (uint32_t side = 0; side < few.sides.size(); ++side) {
    const uint32_t other = few.sides[side];
    if (other == kBorder) continue;
    ASSERT_EQ(few.sides[other], side);
    ASSERT_EQ(few.vertices[other], few.vertices[after(side)]);
    ASSERT_EQ(few.vertices[after(other)], few.vertices[side]);
  }
  const CornerFans fans = cornerFans(few.sides);
  for (uint32_t corner = 0; corner < few.vertices.size(); ++corner)
    EXPECT_EQ(few.vertices[corner], few.vertices[fans.first[fans.of_corner[corner]]]);
  const std::set<Vertex> before = verticesOf(whole), left = verticesOf(few);
  EXPECT_TRUE(std::includes(before.begin(), before.end(), left.begin(), left.end()));
}

void expectSameSurface(const CodedTriangles& whole, uint64_t most) {
  const CodedTriangles few = fewerTriangles(whole, most);
  expectSound(whole, few, most);
  EXPECT_TRUE(surfaceOf(few) == surfaceOf(whole)) << most;
  EXPECT_EQ(made::manifoldFault(inSpace(few)), "") << most;
}

TriangleMesh needles(int levels) {
  std::mt19937 random(3);
  TriangleMesh mesh = made::sphere(levels);
  for (Point& point : mesh.points)
    point = {point[0] * 100, point[1] * (1 + static_cast<double>(random() % 100) / 1e4),
             point[2] * 0.1};
  return mesh;
}

/// A box whose six sides are parts of a texture, apart from each other.
struct PaintedMesh {
  TriangleMesh mesh;
  std::vector<Corners> texcoords;
};

PaintedMesh paintedBox(uint32_t side) {
  std::map<Point, uint32_t> numbers;
  PaintedMesh box;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double at : {0.0, 1.0}) {
      const TriangleMesh grid = made::openGrid(side, side, 0);
      const auto pointOf = [&](uint32_t corner) {
        Point turned;
        turned[axis] = at;
        turned[(axis + 1) % 3] = grid.points[corner][0];
        turned[(axis + 2) % 3] = grid.points[corner][1];
        const auto [found, is_new] =
            numbers.try_emplace(turned, static_cast<uint32_t>(box.mesh.points.size()));
        if (is_new) box.mesh.points.push_back(turned);
        return found->second;
      };
      for (Triangle t : grid.triangles) {
        if (at == 0) std::swap(t[0], t[1]);
        box.mesh.triangles.push_back({pointOf(t[0]), pointOf(t[1]), pointOf(t[2])});
        Corners& corners = box.texcoords.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
          const Point& on = grid.points[t[k]];
          corners[k] = {static_cast<float>((static_cast<double>(axis) + 0.9 * on[0]) / 3),
                        static_cast<float>((at + 0.9 * on[1]) / 2)};
        }
      }
    }
  }
  return box;
}

TEST(FewerTriangles, KeepTheSurface) {
  const std::vector<TriangleMesh> meshes = {
      made::sphere(4),
      made::torus(40, 20),
      made::openGrid(30, 20),
      made::pipe(20, 12),
      made::moebiusStrip(60),
      made::sphereWithLimbs(3),
      needles(4),
      made::beside(made::torus(20, 12), made::pipe(20, 12), {9, 1, 4})};
  for (const TriangleMesh& mesh : meshes) {
    for (const uint32_t places : {60u, 4096u, 1u << 20}) {
      const CodedTriangles whole = coded(mesh, {}, places);
      const auto all = static_cast<uint32_t>(trianglesOf(whole));
      for (const uint32_t most : {all / 2, all / 4, all / 8}) expectSameSurface(whole, most);
    }
  }
}

TEST(FewerTriangles, AreAllWhereTheyMayBe) {
  const CodedTriangles whole = coded(made::torus(12, 9));
  for (const uint64_t most : {216u, 217u, 1000000u})
    EXPECT_EQ(fewerTriangles(whole, most).vertices, whole.vertices);
  EXPECT_EQ(trianglesOf(fewerTriangles(whole, 215)), 214u);
}

TEST(FewerTriangles, OfASphereFaceOutwards) {
  const CodedTriangles whole = coded(made::sphere(5));
  for (const uint64_t most : {4000u, 1000u, 200u, 60u, 20u}) {
    const TriangleMesh mesh = inSpace(fewerTriangles(whole, most));
    EXPECT_GT(mesh.triangles.size() + 2, most);
    Point middle{2048, 2048, 2048};
    for (const Triangle& t : mesh.triangles)
      EXPECT_GT(dot(areaNormal(mesh, t), mesh.points[t[0]] - middle), 0);
  }
}

TEST(FewerTriangles, AreNearerTheMoreThereAre) {
  for (const TriangleMesh& mesh : {made::sphere(5), made::torus(60, 40), made::openGrid(60, 50)}) {
    for (const uint32_t places : {300u, 4096u, 1u << 20}) {
      const CodedTriangles whole = coded(mesh, {}, places);
      const TriangleMesh given = inSpace(whole);
      const TriangleTree tree(given);
      double before = 0.1 * places;
      for (const uint64_t most : {60u, 120u, 240u, 480u, 960u, 1920u}) {
        const TriangleMesh few = inSpace(fewerTriangles(whole, most));
        const double error = meshDistance(tree, TriangleTree(few), 4000).error;
        EXPECT_LT(error, 0.8 * before) << most;
        before = error;
      }
    }
  }
}

/// Flat parts take few triangles: a box two for each side, and its edges stay sharp.
TEST(FewerTriangles, OfABoxAreExact) {
  const PaintedMesh box = paintedBox(12);
  const CodedTriangles whole = coded(box.mesh);
  const TriangleMesh given = inSpace(whole), few = inSpace(fewerTriangles(whole, 12));
  EXPECT_EQ(few.triangles.size(), 12u);
  EXPECT_LT(meshDistance(TriangleTree(given), TriangleTree(few), 4000).to_first.largest, 1e-6);
}

TEST(FewerTriangles, KeepSeams) {
  const PaintedMesh box = paintedBox(12);
  const CodedTriangles whole = coded(box.mesh, box.texcoords);
  for (const uint64_t most : {800u, 200u, 50u, 12u}) {
    const CodedTriangles few = fewerTriangles(whole, most);
    expectSound(whole, few, most);
    EXPECT_TRUE(surfaceOf(few) == surfaceOf(whole));
    // No triangle spans two parts of the texture, and all parts are still covered.
    int64_t area = 0;
    for (size_t corner = 0; corner < few.wedges.size(); corner += 3) {
      const auto at = [&](size_t k) { return few.texcoords[few.wedges[corner + k]]; };
      const int64_t twice = int64_t{at(1)[0] - at(0)[0]} * (at(2)[1] - at(0)[1]) -
                            int64_t{at(1)[1] - at(0)[1]} * (at(2)[0] - at(0)[0]);
      area += std::abs(twice);
    }
    EXPECT_NEAR(static_cast<double>(area) / 2 / 4096 / 4096, 0.81, 0.01) << most;
  }
}

TEST(FewerTriangles, OfCrumbsAreTheLargest) {
  TriangleMesh all = made::torus(40, 30);
  for (int i = 0; i < 500; ++i) {
    TriangleMesh crumb = made::sphere(1);
    for (Point& point : crumb.points) point = (0.001 + 1e-6 * i) * point;
    all = made::beside(all, crumb, {2 + 0.01 * i, 0.02 * (i % 7), 0});
  }
  const CodedTriangles whole = coded(all, {}, 1 << 18);
  for (const uint64_t most : {6000u, 2000u, 300u}) {
    const CodedTriangles few = fewerTriangles(whole, most);
    expectSound(whole, few, most);
    if (most > 300) continue;
    EXPECT_EQ(surfaceOf(few).euler, 0);  // the torus, and nothing else
    EXPECT_EQ(surfaceOf(few).pieces, 1u);
    EXPECT_GT(trianglesOf(few), 290u);
  }
}

TEST(FewerTriangles, AreNoMoreHoweverFewAreAskedFor) {
  std::mt19937 random(11);
  std::vector<TriangleMesh> meshes = {made::sphere(2),
                                      made::torus(9, 7),
                                      made::openGrid(6, 5),
                                      made::moebiusStrip(9),
                                      made::openGrid(1, 1),
                                      needles(2),
                                      made::beside(made::torus(9, 7), made::sphere(1), {5, 5, 5})};
  for (const uint32_t count : {1u, 3u, 40u, 300u}) meshes.push_back(made::soup(random, 30, count));
  for (const TriangleMesh& mesh : meshes) {
    if (cleaned(mesh).mesh.triangles.empty()) continue;
    for (const uint32_t places : {3u, 40u, 1u << 20}) {
      const CodedTriangles whole = coded(mesh, {}, places);
      for (uint64_t most = 1; most < trianglesOf(whole); most += 1 + most / 8)
        expectSound(whole, fewerTriangles(whole, most), most);
    }
  }
}

/// Each triangle is a part of its texture, so that no collapse keeps it.
TEST(FewerTriangles, AreFoundWhereEverySideIsASeam) {
  const TriangleMesh mesh = cleaned(made::torus(30, 20)).mesh;
  std::vector<Corners> texcoords;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto at = static_cast<float>(t) / 2000;
    texcoords.push_back({{{at, 0}, {at, 0.1f}, {at + 0.0004f, 0}}});
  }
  const CodedTriangles whole = coded(mesh, texcoords);
  for (const uint64_t most : {900u, 300u, 40u}) {
    const CodedTriangles few = fewerTriangles(whole, most);
    expectSound(whole, few, most);
    EXPECT_GT(trianglesOf(few) + 2, most);
    EXPECT_TRUE(surfaceOf(few) == surfaceOf(whole)) << most;
  }
}

/// A vertex of very many triangles takes no more time than others.
TEST(FewerTriangles, OfAWideFanAreFound) {
  TriangleMesh fan{{{0, 0, 1}}, {}};
  constexpr uint32_t kTriangles = 200000;
  for (uint32_t i = 0; i < kTriangles; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kTriangles;
    fan.points.push_back({std::cos(angle), std::sin(angle), 0});
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % kTriangles});
  }
  const PlainMesh plain{fan.points, fan.triangles, gluedSides(fan.triangles).opposite, {}};
  const CodedTriangles whole = *decodeTriangles(TriangleEncoder(plain, 0).encode(1 << 20));
  const CodedTriangles few = fewerTriangles(whole, 100);
  EXPECT_EQ(trianglesOf(few), 100u);
  EXPECT_TRUE(surfaceOf(few) == surfaceOf(whole));
}

TEST(FewerTriangles, OfAnyCodewordAreFound) {
  std::mt19937 random(5);
  int decoded = 0;
  for (int round = 0; round < 3000; ++round) {
    const bool textured = round % 2 == 0;
    TriangleMeshHeader header{2 + random() % 14,
                              static_cast<uint8_t>(1 + random() % 20),
                              1,
                              {},
                              static_cast<uint8_t>(textured ? 1 + random() % 20 : 0),
                              0,
                              {},
                              {}};
    for (int i = 0; i < 3000; ++i)
      header.code.push_back(static_cast<char>(random() % (1 + random() % 256)));
    const Result<CodedTriangles> whole = decodeTriangles(header);
    if (!whole.ok()) continue;
    ++decoded;
    for (uint64_t most = 1; most < header.triangles; most += 1 + most / 3)
      expectSound(*whole, fewerTriangles(*whole, most), most);
  }
  EXPECT_GT(decoded, 50);
}

}  // namespace
}  // namespace tetrakis::test
