// SPDX-License-Identifier: Apache-2.0
// Meshes of objects within a number of triangles: they come near to all samples, and stay closed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "tests/support/coded_object.hpp"
#include "tests/support/triangle_meshes.hpp"
#include "tests/support/welded_mesh.hpp"

namespace tetrakis::test {
namespace {

/// Of what a closed mesh is around.
double volumeOf(const DecodedMesh& mesh) {
  double sixfold = 0;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Point &a = mesh.points[mesh.triangles[i]], &b = mesh.points[mesh.triangles[i + 1]],
                &c = mesh.points[mesh.triangles[i + 2]];
    sixfold += dot(a, cross(b, c));
  }
  return sixfold / 6;
}

/// Vertices on the surface would leave the mesh of a ball inside of it.
TEST(ObjectMeshes, OfFewTrianglesAreAsLargeAsTheSurface) {
  const Encoded made = encodeMesh(made::sphere(5), budget(4000), TKS_OBJECT_RESAMPLED);
  const OpenedStream decoder = opened(made.stream, made.stream.size());
  const double whole = volumeOf(decodedMesh(decoder.get(), TKS_MESH_BUDGET, 0));
  for (const uint32_t most : {2 * made.report.patches, 2 * made.report.patches + 300}) {
    const DecodedMesh mesh = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
    EXPECT_LE(mesh.triangles.size() / 3, most);
    EXPECT_NEAR(volumeOf(mesh) / whole, 1, 5e-3) << most;
  }
}

TEST(ObjectMeshes, OfAllTrianglesHaveTheirSamples) {
  const Encoded made = encodeMesh(made::torus(32, 16), budget(2000), TKS_OBJECT_RESAMPLED);
  const OpenedStream decoder = opened(made.stream, made.stream.size());
  const DecodedMesh all = decodedMesh(decoder.get(), TKS_MESH_BUDGET, 0);
  const auto count = static_cast<uint32_t>(all.triangles.size() / 3);
  EXPECT_EQ(decodedMesh(decoder.get(), TKS_MESH_BUDGET, count).points, all.points);
}

/// A torus with a texture, resampled.
Encoded texturedTorus() {
  const TriangleMesh torus = made::torus(40, 20);
  const GivenMesh given(torus);
  const std::vector<float> texcoords(6 * torus.triangles.size(), 0.5F);
  const std::vector<uint8_t> texels(3 * 8 * 8, 90);
  tks_image image{};
  image.size = sizeof image;
  image.width = image.height = 8;
  image.channels = 3;
  image.sample = TKS_U8;
  image.data = texels.data();
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = texcoords.data();
  mesh.kind = TKS_OBJECT_RESAMPLED;
  return encodeMesh(mesh, budget(3000), &image);
}

/// Vertices of patches on both sides of a seam lie at the same place to the last bit.
TEST(ObjectMeshes, AreClosedAlongTheSeamsOfTheirTexture) {
  const Encoded made = texturedTorus();
  const size_t header = headerBytes(made.stream);
  for (const size_t length : {header, (header + made.stream.size()) / 2, made.stream.size()}) {
    const OpenedStream decoder = opened(made.stream, length);
    for (const uint32_t most : {3 * made.report.patches, 5000u, 0u}) {
      const DecodedMesh shown = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
      const checks::WeldedMesh welded = checks::weldedMesh(shown.points, shown.triangles);
      EXPECT_EQ(welded.open, 0u) << length << " bytes, " << most;
      EXPECT_EQ(welded.euler(), 0) << length << " bytes, " << most;
    }
  }
}

/// The edges whose ends other edges have, too.
size_t doubleEdges(const DecodedMesh& mesh) {
  std::map<std::array<std::array<double, 3>, 2>, int> ways;
  size_t count = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t next = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    count += ++ways[{mesh.points[mesh.triangles[i]], mesh.points[next]}] > 1;
  }
  return count;
}

/// Below two triangles for each patch vertices collapse over the sides of patches.
TEST(ObjectMeshes, HaveFewerTrianglesThanTheirPatches) {
  const Encoded made = texturedTorus();
  const size_t header = headerBytes(made.stream);
  const uint32_t base = 2 * made.report.patches;
  for (const size_t length : {header, (header + made.stream.size()) / 2, made.stream.size()}) {
    const OpenedStream decoder = opened(made.stream, length);
    for (const uint32_t most : {base + 1, base, base - 1, base / 2, 40u}) {
      const DecodedMesh shown = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
      EXPECT_LE(shown.triangles.size() / 3, most);
      EXPECT_GE(shown.triangles.size() / 3, most - 4);
      const checks::WeldedMesh welded = checks::weldedMesh(shown.points, shown.triangles);
      EXPECT_EQ(welded.open, 0u) << length << " bytes, " << most;
      EXPECT_EQ(welded.euler(), 0) << length << " bytes, " << most;
      EXPECT_EQ(doubleEdges(shown), 0u) << length << " bytes, " << most;
    }
    for (uint32_t most = 1; most <= 30; ++most) {
      const DecodedMesh shown = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
      EXPECT_LE(shown.triangles.size() / 3, most);
      EXPECT_GE(shown.triangles.size(), 3u);
    }
  }
}

/// Each triangle shows a part of one patch of the texture.
TEST(ObjectMeshes, OfFewTrianglesShowWhatLiesWithinAPatch) {
  const Encoded made = texturedTorus();
  const OpenedStream decoder = opened(made.stream, made.stream.size());
  const DecodedMesh shown = decodedMesh(decoder.get(), TKS_MESH_BUDGET, made.report.patches);
  const double patches = made.report.patches;
  ASSERT_EQ(shown.texcoords.size(), shown.points.size());
  for (size_t i = 0; i < shown.triangles.size(); i += 3) {
    const auto patchOf = [&](size_t k) {
      return std::floor(shown.texcoords[shown.triangles[i + k]][1] * patches);
    };
    EXPECT_EQ(patchOf(0), patchOf(1));
    EXPECT_EQ(patchOf(0), patchOf(2));
  }
}

/// As far as the surface of a ball is from its mesh of all samples.
TEST(ObjectMeshes, OfFewerTrianglesThanPatchesStayNearTheSurface) {
  const Encoded made = encodeMesh(made::sphere(5), budget(4000), TKS_OBJECT_RESAMPLED);
  const OpenedStream decoder = opened(made.stream, made.stream.size());
  const uint32_t most = made.report.patches;
  const DecodedMesh mesh = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
  // Of a ball in n even triangles the volume is 1 - 7.3 / n of its own.
  const double whole = volumeOf(decodedMesh(decoder.get(), TKS_MESH_BUDGET, 0));
  EXPECT_NEAR(volumeOf(mesh) / whole, 1, 3 * 7.3 / most);
}

}  // namespace
}  // namespace tetrakis::test
