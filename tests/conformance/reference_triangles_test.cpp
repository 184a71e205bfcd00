// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): meshes of triangles that are coded as
// they are.
#include <random>
#include <string>
#include <utility>

#include "bitstream/stream/header.hpp"
#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/half_edges.hpp"
#include "codec/trianglemesh/triangle_encoder.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::test {
namespace {

using Corners = std::array<std::array<float, 2>, 3>;

/// Over a map that folds, with seams between one in `seams` triangles.
std::vector<Corners> texcoordsOf(const TriangleMesh& mesh, uint32_t seams) {
  std::mt19937 random(seams);
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    const float shift = random() % seams == 0 ? static_cast<float>(random() % 64) / 16 : 0;
    Corners& corners = all.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const Point& at = mesh.points[t[k]];
      corners[k] = {static_cast<float>(at[0] + 0.3 * at[2]) + shift, static_cast<float>(at[1])};
    }
  }
  return all;
}

TriangleMeshHeader headerOf(const TriangleMesh& mesh, const std::vector<Corners>& texcoords,
                            uint32_t places) {
  return TriangleEncoder(
             {mesh.points, mesh.triangles, gluedSides(mesh.triangles).opposite, texcoords}, 9)
      .encode(places);
}

/// Whether both say that it is sound.
bool agreeOn(const TriangleMeshHeader& mesh) {
  StreamHeader header;
  header.triangle_mesh = mesh;
  const Bytes stream = writeHeader(header);
  const auto told = reference::decodeTriangles(stream);
  Stream decoder(stream);
  tks_object_mesh out = {};
  const tks_status status = tks_decode_object(decoder.get(), TKS_MESH_BUDGET, 0, &out);
  EXPECT_TRUE(told.has_value());
  EXPECT_EQ(status, told->sound ? TKS_OK : TKS_CORRUPT);
  for (size_t corner = 0; corner < told->places.size() && status == TKS_OK; ++corner) {
    const uint32_t v = out.triangles[corner];
    for (size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(out.position[3 * v + axis], told->places[corner][axis]);
    for (size_t axis = 0; axis < 2 && !told->texcoords.empty(); ++axis)
      EXPECT_EQ(out.texcoord[2 * v + axis], told->texcoords[corner][axis]);
  }
  tks_free_object_mesh(&out);
  return told->sound;
}

std::vector<TriangleMesh> meshes() {
  std::mt19937 random(3);
  std::vector<TriangleMesh> all = {made::sphere(2), made::torus(7, 5), made::pipe(5, 3),
                                   made::openGrid(7, 4), made::moebiusStrip(6)};
  for (const uint32_t count : {2u, 30u, 90u}) all.push_back(made::soup(random, 20, count));
  for (TriangleMesh& mesh : all) mesh = cleaned(mesh).mesh;
  return all;
}

TEST(ReferenceTriangles, Agrees) {
  for (const TriangleMesh& mesh : meshes()) {
    for (const auto& [places, seams] : {std::pair(6u, 1u), {256, 4}, {9000, 50}, {1 << 20, 1000}}) {
      EXPECT_TRUE(agreeOn(headerOf(mesh, {}, places)));
      EXPECT_TRUE(agreeOn(headerOf(mesh, texcoordsOf(mesh, seams), places)));
      if (HasFailure()) return;
    }
  }
}

/// Noise behind a sound beginning: sides are glued however they can be.
TEST(ReferenceTriangles, AgreesOnDamagedCodewords) {
  std::mt19937 random(5);
  int sound = 0, unsound = 0;
  for (const TriangleMesh& mesh : meshes()) {
    const TriangleMeshHeader whole = headerOf(mesh, texcoordsOf(mesh, 5), 4096);
    for (int i = 0; i < 60; ++i) {
      TriangleMeshHeader damaged = whole;
      damaged.code.resize(random() % (whole.code.size() + 1));
      const size_t noise = random() % 400;
      for (size_t k = 0; k < noise; ++k) damaged.code.push_back(static_cast<char>(random()));
      ++(agreeOn(damaged) ? sound : unsound);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(sound, 20);
  EXPECT_GT(unsound, 20);
}

TEST(ReferenceTriangles, AgreesOnStreams) {
  const TriangleMesh mesh = cleaned(made::torus(6, 5)).mesh;
  const Raster image = make({Pattern::kRidges, 20, 17, 3, TKS_U8});
  const Bytes texture = encode(nullptr, &image, budget(500));
  const size_t start = readHeader(texture)->bytes;
  StreamHeader header = readHeader(texture)->header;
  header.triangle_mesh = headerOf(mesh, texcoordsOf(mesh, 4), 512);
  Bytes stream = writeHeader(header);
  stream.insert(stream.end(), texture.begin() + static_cast<ptrdiff_t>(start), texture.end());
  expectAgreementOnPrefixes(stream);
  for (int change = 0; change < 3; ++change) {
    StreamHeader other = header;
    if (change == 0) other.triangle_mesh.texcoord_bits = 0;  // a texture without places
    if (change == 1) other.texture->wavelet.ring = true;
    if (change == 2) other.texture.reset();
    expectAgreement(writeHeader(other));
  }
}

}  // namespace
}  // namespace tetrakis::test
