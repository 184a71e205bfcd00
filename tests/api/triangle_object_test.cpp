// SPDX-License-Identifier: Apache-2.0
// Objects whose triangles are coded as they are, through the C interface.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/support/given_mesh.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::test {
namespace {

tks_encode_options toPsnr(double psnr) {
  tks_encode_options options{};
  options.size = sizeof options;
  options.psnr = psnr;
  return options;
}

struct EncodedTriangles {
  Bytes stream;
  tks_object_report report{};
  tks_status status = TKS_OK;
  std::string message;
};

EncodedTriangles encodeAs(tks_object_kind kind, tks_triangle_mesh mesh,
                          const tks_encode_options& options, const tks_image* image = nullptr) {
  EncodedTriangles out;
  out.report.size = sizeof out.report;
  tks_buffer buffer{};
  std::array<char, 300> message{};
  mesh.kind = kind;
  out.status = tks_encode_object(&mesh, image, &options, &out.report, &buffer, message.data(),
                                 message.size());
  out.message = message.data();
  if (buffer.data != nullptr) out.stream.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return out;
}

/// A cube whose sides are grids of 2 * side² triangles: what is designed, and not scanned.
TriangleMesh cube(uint32_t side) {
  TriangleMesh all;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double at : {0.0, 1.0}) {
      TriangleMesh grid = made::openGrid(side, side, 0);
      for (Point& p : grid.points) {
        Point turned;
        turned[axis] = at;
        turned[(axis + 1) % 3] = p[0];
        turned[(axis + 2) % 3] = p[1];
        p = turned;
      }
      if (at == 0)
        for (Triangle& t : grid.triangles) std::swap(t[0], t[1]);
      all = made::beside(all, grid, {0, 0, 0});
    }
  }
  return all;
}

TEST(TriangleObjects, AreTakenWhereTheyAreNearer) {
  const GivenMesh sharp(cube(4)), round(made::sphere(5));
  const EncodedTriangles of_cube = encodeAs(TKS_OBJECT_AUTO, sharp.given(), budget(1000));
  EXPECT_EQ(of_cube.report.kind, TKS_OBJECT_TRIANGLES);
  EXPECT_EQ(of_cube.report.patches, 0u);
  EXPECT_GT(of_cube.report.psnr, 100);
  const EncodedTriangles of_sphere = encodeAs(TKS_OBJECT_AUTO, round.given(), budget(1000));
  EXPECT_EQ(of_sphere.report.kind, TKS_OBJECT_RESAMPLED);
  EXPECT_EQ(of_sphere.report.coded_triangles, 0u);
  EXPECT_GT(of_sphere.report.patches, 0u);
}

TEST(TriangleObjects, KeepEveryTarget) {
  const GivenMesh torus(made::torus(40, 20));
  double before = 0;
  for (const uint64_t bytes : {200, 600, 1500, 5000}) {
    const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), budget(bytes));
    EXPECT_LE(made.stream.size(), bytes);
    EXPECT_GT(made.report.psnr, before);
    before = made.report.psnr;
  }
  for (const double psnr : {40.0, 55.0, 70.0, 90.0}) {
    const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), toPsnr(psnr));
    EXPECT_GE(made.report.psnr, psnr);
    EXPECT_LT(made.report.psnr, psnr + 7);
  }
  for (const double bound : {0.1, 1e-3, 1e-5}) {
    const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), within(bound));
    EXPECT_LE(made.report.largest, bound);
    EXPECT_EQ(made.report.coded_triangles, 1600u);
  }
}

TEST(TriangleObjects, ComeWithTheHeader) {
  const GivenMesh torus(made::torus(12, 10));
  const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), within(1e-3));
  Stream stream(made.stream);
  EXPECT_EQ(stream.info().has_heights, 0);
  EXPECT_EQ(stream.info().has_texture, 0);
  EXPECT_EQ(stream.info().object_triangles, 240u);
  EXPECT_EQ(stream.info().header_bytes, made.stream.size());
  EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
  for (size_t cut = 0; cut < made.stream.size(); ++cut) {
    tks_decoder* decoder = nullptr;
    EXPECT_EQ(tks_open(made.stream.data(), cut, nullptr, &decoder, nullptr, 0), TKS_TRUNCATED);
  }
  tks_object_mesh mesh{};
  EXPECT_EQ(tks_decode_object(stream.get(), TKS_MESH_BUDGET, 240, &mesh), TKS_OK);
  EXPECT_EQ(mesh.vertex_count, 120u);
  EXPECT_EQ(mesh.triangle_count, 240u);
  EXPECT_EQ(mesh.pixel, nullptr);
  EXPECT_EQ(mesh.texcoord, nullptr);
  EXPECT_EQ(mesh.height, nullptr);
  tks_free_object_mesh(&mesh);
  EXPECT_EQ(mesh.position, nullptr);
}

TEST(TriangleObjects, AreDrawnWithFewerTriangles) {
  const GivenMesh torus(made::torus(40, 20));
  const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), within(1e-4));
  Stream stream(made.stream);
  std::set<std::array<double, 3>> places;
  tks_object_mesh mesh{};
  ASSERT_EQ(tks_decode_object(stream.get(), TKS_MESH_CODED, 10, &mesh), TKS_OK);
  EXPECT_EQ(mesh.triangle_count, 1600u);
  for (uint32_t v = 0; v < mesh.vertex_count; ++v)
    places.insert({mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]});
  tks_free_object_mesh(&mesh);
  for (const uint32_t most : {1599u, 1000u, 300u, 40u, 1u}) {
    ASSERT_EQ(tks_decode_object(stream.get(), TKS_MESH_BUDGET, most, &mesh), TKS_OK);
    EXPECT_LE(mesh.triangle_count, most);
    EXPECT_GT(mesh.triangle_count, 0u);
    if (most >= 40) {
      EXPECT_GT(mesh.triangle_count + 2, most);
      EXPECT_EQ(2 * mesh.vertex_count, mesh.triangle_count);
    }
    for (uint32_t v = 0; v < mesh.vertex_count; ++v)
      EXPECT_EQ(
          places.count({mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]}),
          1u);
    for (uint32_t i = 0; i < 3 * mesh.triangle_count; ++i)
      EXPECT_LT(mesh.triangles[i], mesh.vertex_count);
    tks_free_object_mesh(&mesh);
  }
}

TEST(TriangleObjects, TakeNoMoreMemoryThanIsAllowed) {
  const GivenMesh torus(made::torus(64, 32));
  const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), within(1e-3));
  tks_limits limits{};
  limits.size = sizeof limits;
  limits.max_memory = 500000;
  Stream stream(made.stream, &limits);
  tks_object_mesh mesh{};
  EXPECT_EQ(tks_decode_object(stream.get(), TKS_MESH_BUDGET, 0, &mesh), TKS_LIMIT);
}

/// Any text goes there and back, whoever cuts the stream; and texcoords are as fine as what will
/// lie on them.
TEST(TriangleObjects, KeepTheirMaterialAndTexcoordsForOthers) {
  const std::array<uint8_t, 3> texel = {10, 200, 90};
  tks_image image{};
  image.size = sizeof image;
  image.width = image.height = 1;
  image.channels = 3;
  image.sample = TKS_U8;
  image.data = texel.data();
  const TriangleMesh torus = made::torus(16, 12);
  std::vector<float> texcoords;
  for (size_t i = 0; i < 6 * torus.triangles.size(); ++i)
    texcoords.push_back(static_cast<float>(i * 37 % 1009) / 1009);
  const GivenMesh given(torus);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = texcoords.data();
  mesh.material = "{\"any\": [bytes \x07";
  double before = 0;
  for (const uint32_t texels : {0u, 16u, 4096u, 0xffffffffu}) {
    mesh.texels = texels;
    const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, mesh, budget(60000), &image);
    ASSERT_EQ(made.status, TKS_OK) << made.message;
    Stream stream(made.stream);
    EXPECT_STREQ(stream.info().material, mesh.material);
    Stream cut(Prefix(made.stream).first(static_cast<size_t>(stream.info().header_bytes)));
    EXPECT_STREQ(cut.info().material, mesh.material);
    tks_object_mesh out{};
    ASSERT_EQ(tks_decode_object(stream.get(), TKS_MESH_BUDGET, 0, &out), TKS_OK);
    double farthest = 0;  // from multiples of 1 / 1009
    for (uint32_t i = 0; i < 2 * out.vertex_count; ++i)
      farthest = std::max(farthest, std::abs(std::remainder(out.texcoord[i], 1.0 / 1009)));
    tks_free_object_mesh(&out);
    if (texels == 4096) {
      EXPECT_LT(farthest, 0.5 / 8192);
    }
    if (texels == 16) {
      EXPECT_GT(farthest, 0.25 / 1009);
    }
    before = farthest;
  }
  EXPECT_LT(before, 0.5 / 8192);
  mesh.material = nullptr;
  const EncodedTriangles plain = encodeAs(TKS_OBJECT_TRIANGLES, mesh, budget(60000), &image);
  EXPECT_STREQ(Stream(plain.stream).info().material, "");
}

/// A torus under an image whose colours say where they are; its texcoords go round several times.
TEST(TriangleObjects, HaveTheirTexture) {
  constexpr uint32_t kSide = 64;
  std::vector<uint8_t> texels;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x)
      for (const uint32_t value : {4 * x, 4 * y, 77u})
        texels.push_back(static_cast<uint8_t>(value));
  tks_image image{};
  image.size = sizeof image;
  image.width = image.height = kSide;
  image.channels = 3;
  image.sample = TKS_U8;
  image.data = texels.data();
  const TriangleMesh torus = made::torus(16, 12);
  std::vector<float> texcoords;
  for (const Triangle& t : torus.triangles)
    for (const uint32_t corner : t)
      for (size_t axis = 0; axis < 2; ++axis)
        texcoords.push_back(static_cast<float>(torus.points[corner][axis]));
  const GivenMesh given(torus);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = texcoords.data();
  const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, mesh, budget(9000), &image);
  ASSERT_EQ(made.status, TKS_OK) << made.message;
  EXPECT_LE(made.stream.size(), 9000u);
  EXPECT_EQ(made.report.texture_depth, 0u);
  // The image comes back exactly where bytes are ample, but corners are rounded all the same.
  const EncodedTriangles ample = encodeAs(TKS_OBJECT_TRIANGLES, mesh, budget(200000), &image);
  Stream exact(ample.stream);
  EXPECT_TRUE(std::isinf(exact.info().texture_psnr));
  EXPECT_EQ(exact.info().lossless, 0);
  EXPECT_EQ(tks_verify(exact.get()), TKS_OK);
  Stream stream(made.stream);
  EXPECT_EQ(stream.info().texture_width, kSide);
  EXPECT_EQ(stream.info().texture_domain, TKS_DOMAIN_PLANE);
  tks_object_mesh out{};
  ASSERT_EQ(tks_decode_object(stream.get(), TKS_MESH_BUDGET, 0, &out), TKS_OK);
  EXPECT_EQ(out.triangle_count, 384u);
  // Texcoords were the places themselves, up to whole numbers.
  for (uint32_t v = 0; v < out.vertex_count; ++v) {
    for (size_t axis = 0; axis < 2; ++axis) {
      const double off = out.texcoord[2 * v + axis] - out.position[3 * v + axis];
      EXPECT_NEAR(off, std::round(off), 0.01);
    }
  }
  tks_free_object_mesh(&out);
  const auto header = static_cast<size_t>(stream.info().header_bytes);
  for (const size_t length : {header, (header + made.stream.size()) / 2}) {
    Stream cut(Prefix(made.stream).first(length));
    EXPECT_EQ(cut.status(), TKS_OK);
    EXPECT_EQ(cut.texture().size(), texels.size());
    EXPECT_EQ(tks_decode_object(cut.get(), TKS_MESH_BUDGET, 0, &out), TKS_OK);
    tks_free_object_mesh(&out);
  }
}

TEST(TriangleObjects, OfOneTriangleMeetEveryTarget) {
  for (const uint32_t count : {1u, 2u, 3u}) {
    TriangleMesh few;
    for (uint32_t t = 0; t < count; ++t) {
      few.points.insert(few.points.end(),
                        {{2.0 * t, 0, 0}, {2.0 * t + 1, 0, 0.1}, {2.0 * t, 1, 0}});
      few.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const GivenMesh given(few);
    for (const tks_encode_options& options : {budget(200), toPsnr(60), within(0.01)}) {
      const EncodedTriangles made = encodeAs(TKS_OBJECT_TRIANGLES, given.given(), options);
      EXPECT_EQ(made.status, TKS_OK) << made.message;
      EXPECT_EQ(made.report.coded_triangles, count);
    }
  }
}

TEST(TriangleObjects, ThatCannotBeAreASentence) {
  const GivenMesh torus(made::torus(40, 20));
  const EncodedTriangles few = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), budget(45));
  EXPECT_EQ(few.status, TKS_USAGE);
  EXPECT_EQ(few.message, "No mesh of triangles fits in so few bytes.");
  const EncodedTriangles fine = encodeAs(TKS_OBJECT_TRIANGLES, torus.given(), within(1e-9));
  EXPECT_EQ(fine.message, "No grid for triangles is as fine as asked for: ask for a larger error.");
  const auto odd = static_cast<tks_object_kind>(3);
  EXPECT_EQ(encodeAs(odd, torus.given(), budget(900)).message, "Unknown kind of object.");
}

/// Ten thousand parts are more than the patches of a stream.
TEST(TriangleObjects, OfManyPartsAreTriangles) {
  TriangleMesh parts;
  for (uint32_t i = 0; i < 10000; ++i) {
    const double x = i % 100, y = i / 100;
    const auto first = static_cast<uint32_t>(parts.points.size());
    parts.points.insert(parts.points.end(), {{x, y, 0}, {x + 0.5, y, 0.1}, {x, y + 0.5, 0.2}});
    parts.triangles.push_back({first, first + 1, first + 2});
  }
  const GivenMesh given(parts);
  const EncodedTriangles made = encodeAs(TKS_OBJECT_AUTO, given.given(), budget(60000));
  ASSERT_EQ(made.status, TKS_OK) << made.message;
  EXPECT_EQ(made.report.kind, TKS_OBJECT_TRIANGLES);
  EXPECT_EQ(made.report.components, 10000u);
}

}  // namespace
}  // namespace tetrakis::test
