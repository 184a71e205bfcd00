// SPDX-License-Identifier: Apache-2.0
// Meshes of objects within a number of triangles: they come near to all samples, and stay closed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

/// Vertices of patches on both sides of a seam lie at the same place to the last bit.
TEST(ObjectMeshes, AreClosedAlongTheSeamsOfTheirTexture) {
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
  const Encoded made = encodeMesh(mesh, budget(3000), &image);
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

}  // namespace
}  // namespace tetrakis::test
