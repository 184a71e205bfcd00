// SPDX-License-Identifier: Apache-2.0
// Meshes of triangles that are coded as they are: they come back, whatever they are, and no
// codeword keeps a decoder busy.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/half_edges.hpp"
#include "codec/trianglemesh/triangle_encoder.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::test {
namespace {

using Corners = std::array<std::array<float, 2>, 3>;

std::vector<TriangleMesh> meshes() {
  std::mt19937 random(7);
  std::vector<TriangleMesh> all = {made::sphere(2),
                                   made::torus(9, 7),
                                   made::openGrid(6, 5),
                                   made::pipe(7, 4),
                                   made::moebiusStrip(9),
                                   made::sphereWithLimbs(2),
                                   made::beside(made::torus(5, 4), made::pipe(3, 2), {9, 1, -4})};
  for (const uint32_t count : {1u, 3u, 40u, 300u}) all.push_back(made::soup(random, 30, count));
  for (TriangleMesh& mesh : all) mesh = cleaned(mesh).mesh;
  std::erase_if(all, [](const TriangleMesh& mesh) { return mesh.triangles.empty(); });
  return all;
}

/// Places on a texture: of a map that is continuous, with some triangles torn off.
std::vector<Corners> texcoordsOf(const TriangleMesh& mesh, uint32_t torn) {
  std::mt19937 random(torn);
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners& corners = all.emplace_back();
    const float shift = random() % 10 < torn ? static_cast<float>(random() % 100) / 10 - 5 : 0;
    for (size_t k = 0; k < 3; ++k) {
      const Point& at = mesh.points[t[k]];
      corners[k] = {static_cast<float>(0.3 * at[0] + 0.1 * at[2]) + shift,
                    static_cast<float>(0.25 * at[1] - 0.05 * at[2])};
    }
  }
  return all;
}

TriangleEncoder encoderOf(const TriangleMesh& mesh, const std::vector<Corners>& texcoords,
                          uint8_t fraction = 12) {
  return {{mesh.points, mesh.triangles, gluedSides(mesh.triangles).opposite, texcoords}, fraction};
}

/// A triangle by its corners, from the least one on: in which order triangles come is not kept.
using Shape = std::array<std::array<double, 5>, 3>;

Shape turned(Shape shape) {
  Shape least = shape;
  for (int i = 0; i < 2; ++i) {
    std::rotate(shape.begin(), shape.begin() + 1, shape.end());
    least = std::min(least, shape);
  }
  return least;
}

/// Rounded to cells and to parts of texels, where parts of a texture may be moved by whole numbers.
std::vector<Shape> shapesOf(const TriangleMesh& mesh, const std::vector<Corners>& texcoords,
                            double cell, double unit) {
  std::vector<Shape> all;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    Shape& shape = all.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const Point& at = mesh.points[mesh.triangles[t][k]];
      for (size_t axis = 0; axis < 3; ++axis) shape[k][axis] = std::floor(at[axis] / cell + 0.5);
      for (size_t axis = 0; axis < 2 && !texcoords.empty(); ++axis) {
        const double inside = texcoords[t][k][axis] - std::floor(texcoords[t][k][axis]);
        shape[k][3 + axis] = std::fmod(std::floor(inside * unit + 0.5), unit);
      }
    }
    shape = turned(shape);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Shape> shapesOf(const TriangleMeshHeader& header, const CodedTriangles& mesh,
                            double unit) {
  std::vector<Shape> all(header.triangles);
  for (size_t corner = 0; corner < mesh.vertices.size(); ++corner) {
    auto& place = all[corner / 3][corner % 3];
    for (size_t axis = 0; axis < 3; ++axis)
      place[axis] =
          static_cast<double>(header.origin[axis] + mesh.places[mesh.vertices[corner]][axis]);
    for (size_t axis = 0; axis < 2 && !mesh.wedges.empty(); ++axis) {
      const auto whole = static_cast<double>(header.texcoord_origin[axis] +
                                             mesh.texcoords[mesh.wedges[corner]][axis]);
      place[3 + axis] = std::fmod(std::fmod(whole, unit) + unit, unit);
    }
  }
  for (Shape& shape : all) shape = turned(shape);
  std::sort(all.begin(), all.end());
  return all;
}

TEST(TriangleMeshes, ComeBackAsTheyAre) {
  for (const TriangleMesh& mesh : meshes()) {
    for (const uint32_t places : {3u, 100u, 4096u, 1u << 20}) {
      const TriangleMeshHeader header = encoderOf(mesh, {}).encode(places);
      const Result<CodedTriangles> decoded = decodeTriangles(header);
      ASSERT_TRUE(decoded.ok());
      EXPECT_TRUE(shapesOf(header, *decoded, 1) == shapesOf(mesh, {}, header.cell, 1));
    }
  }
}

TEST(TriangleMeshes, ComeBackWithTheirTexture) {
  constexpr double kUnit = 4096;
  for (const TriangleMesh& mesh : meshes()) {
    for (const uint32_t torn : {0u, 1u, 10u}) {
      const std::vector<Corners> texcoords = texcoordsOf(mesh, torn);
      const TriangleMeshHeader header = encoderOf(mesh, texcoords).encode(1024);
      EXPECT_EQ(header.texcoord_fraction, 12);
      const Result<CodedTriangles> decoded = decodeTriangles(header);
      ASSERT_TRUE(decoded.ok());
      EXPECT_TRUE(shapesOf(header, *decoded, kUnit) ==
                  shapesOf(mesh, texcoords, header.cell, kUnit));
    }
  }
}

TEST(TriangleMeshes, ShareVerticesAndWedgesWhereTheyDid) {
  const TriangleMesh mesh = cleaned(made::torus(12, 9)).mesh;
  const Result<CodedTriangles> plain = decodeTriangles(encoderOf(mesh, {}).encode(1024));
  EXPECT_EQ(plain->places.size(), mesh.points.size());
  EXPECT_TRUE(plain->wedges.empty());
  const Result<CodedTriangles> whole =
      decodeTriangles(encoderOf(mesh, texcoordsOf(mesh, 0)).encode(1024));
  EXPECT_EQ(whole->texcoords.size(), mesh.points.size());
  const Result<CodedTriangles> torn =
      decodeTriangles(encoderOf(mesh, texcoordsOf(mesh, 10)).encode(1024));
  EXPECT_GT(torn->texcoords.size(), 2 * mesh.points.size());
}

/// What Draco takes of regular meshes, and more, would be too much.
TEST(TriangleMeshes, TakeFewBitsForEachVertex) {
  const TriangleMesh mesh = cleaned(made::sphere(5)).mesh;
  const TriangleMeshHeader header = encoderOf(mesh, {}).encode(2048);
  EXPECT_LT(8.0 * static_cast<double>(header.code.size()),
            9.0 * static_cast<double>(mesh.points.size()));
}

TEST(TriangleMeshes, TextureCoordinatesOfAnyNumberAreTaken) {
  const TriangleMesh mesh = cleaned(made::openGrid(4, 4)).mesh;
  for (const float odd : {1e30f, -1e30f, std::nanf(""), INFINITY, 3e5f, -1e-30f}) {
    std::vector<Corners> texcoords = texcoordsOf(mesh, 0);
    texcoords[5][1] = {odd, -odd};
    const TriangleMeshHeader header = encoderOf(mesh, texcoords).encode(1024);
    EXPECT_TRUE(decodeTriangles(header).ok());
    EXPECT_LE(header.texcoord_bits, TriangleMeshHeader::kMostTexcoordBits);
  }
}

TEST(TriangleMeshes, FarFromTheOriginLieOnTheFinestGridThereIs) {
  TriangleMesh mesh = made::sphere(1);
  for (Point& point : mesh.points) point = 1e-6 * point + Point{1e6, -3e7, 0};
  mesh = cleaned(mesh).mesh;
  ASSERT_FALSE(mesh.triangles.empty());
  EXPECT_TRUE(decodeTriangles(encoderOf(mesh, {}).encode(1 << 20)).ok());
}

/// Ends early: corrupt. Damaged: a mesh, or corrupt.
TEST(TriangleMeshes, OfAnyCodewordEnd) {
  for (const TriangleMesh& mesh : meshes()) {
    const TriangleMeshHeader sound = encoderOf(mesh, texcoordsOf(mesh, 1)).encode(256);
    for (size_t bytes = 0; bytes + 5 < sound.code.size(); bytes += 1 + bytes / 20) {
      TriangleMeshHeader cut = sound;
      cut.code.resize(bytes);
      EXPECT_EQ(decodeTriangles(cut).status().code(), TKS_CORRUPT);
    }
    for (size_t byte = 0; byte < sound.code.size(); byte += 1 + byte / 30) {
      TriangleMeshHeader damaged = sound;
      damaged.code[byte] = static_cast<char>(damaged.code[byte] ^ 0x55);
      const Result<CodedTriangles> decoded = decodeTriangles(damaged);
      if (!decoded.ok()) continue;
      EXPECT_EQ(decoded->vertices.size(), 3 * sound.triangles);
      for (const Place& place : decoded->places)
        for (const int32_t value : place) EXPECT_TRUE(value >= 0 && value < 256);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
