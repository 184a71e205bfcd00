// SPDX-License-Identifier: Apache-2.0
// Objects through the C interface: meshes of triangles in, streams, meshes of any prefix out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/coded_object.hpp"
#include "tests/support/triangle_meshes.hpp"
#include "tests/support/welded_mesh.hpp"

namespace tetrakis::test {
namespace {

double radiusOf(const std::array<double, 3>& point) {
  return std::sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
}

TEST(ObjectStreams, KeepASphereRound) {
  const Encoded sphere = encodeMesh(made::sphere(4), budget(1500));
  EXPECT_LE(sphere.stream.size(), 1500u);
  const OpenedStream decoder = opened(sphere.stream, sphere.stream.size());
  for (const auto& point : decodedMesh(decoder.get(), TKS_MESH_BUDGET, 0).points)
    EXPECT_NEAR(radiusOf(point), 1, 0.01);
  EXPECT_GT(sphere.report.psnr, 60);
  EXPECT_EQ(sphere.report.components, 1u);
  EXPECT_EQ(sphere.report.borders, 0u);
}

TEST(ObjectStreams, GetBetterWithMoreBytes) {
  const TriangleMesh torus = made::torus(64, 32);
  double before = 0;
  for (const uint64_t bytes : {700, 1500, 3000}) {
    const Encoded made = encodeMesh(torus, budget(bytes));
    EXPECT_LE(made.stream.size(), bytes);
    EXPECT_GT(made.report.psnr, before);
    before = made.report.psnr;
  }
}

TEST(ObjectStreams, ReachThePsnrAskedFor) {
  for (const double psnr : {45.0, 55.0, 65.0}) {
    tks_encode_options options{};
    options.size = sizeof options;
    options.psnr = psnr;
    const Encoded made = encodeMesh(made::sphereWithLimbs(4), options);
    EXPECT_GE(made.report.psnr, psnr - 0.3) << "reports count other places than the search";
    EXPECT_LE(made.report.psnr, psnr + 6);
  }
}

/// Rings of open edges and Euler characteristics are those of the input, whatever is decoded.
TEST(ObjectStreams, KeepTheirTopologyAtEveryPrefixAndBudget) {
  struct Shape {
    TriangleMesh mesh;
    long euler;
    size_t loops;
  };
  const std::vector<Shape> shapes = {{made::sphere(3), 2, 0},
                                     {made::torus(32, 16), 0, 0},
                                     {made::openGrid(20, 20), 1, 1},
                                     {made::pipe(16, 12), 0, 2}};
  for (const Shape& shape : shapes) {
    const Encoded made = encodeMesh(shape.mesh, budget(1200), TKS_OBJECT_RESAMPLED);
    const size_t header = headerBytes(made.stream), size = made.stream.size();
    for (const size_t length : {header, header + 1, (header + size) / 2, size}) {
      const OpenedStream decoder = opened(made.stream, length);
      for (const uint32_t most : {1u, 300u, 1000u, 5000u}) {
        const DecodedMesh mesh = decodedMesh(decoder.get(), TKS_MESH_BUDGET, most);
        EXPECT_LE(mesh.triangles.size() / 3, most);
        EXPECT_GT(mesh.triangles.size(), 0u);
        if (most == 1) continue;  // no surface is closed then
        // By places on the raster: distinct samples may lie at equal points.
        const checks::WeldedMesh welded = checks::weldedMesh(mesh.pixels, mesh.triangles);
        EXPECT_EQ(welded.euler(), shape.euler) << length << " bytes, " << most;
        EXPECT_EQ(welded.loops, shape.loops) << length << " bytes, " << most;
      }
    }
  }
}

TEST(ObjectStreams, HaveTheTextureOfTheirMesh) {
  // Colours that say where on the square they are.
  constexpr uint32_t kSide = 64;
  std::vector<uint8_t> texels;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x)
      for (const uint32_t value : {4 * x, 4 * y, 128u})
        texels.push_back(static_cast<uint8_t>(value));
  tks_image image{};
  image.size = sizeof image;
  image.width = image.height = kSide;
  image.channels = 3;
  image.sample = TKS_U8;
  image.data = texels.data();
  const TriangleMesh grid = made::openGrid(24, 24, 0.05);
  std::vector<float> texcoords;
  for (const Triangle& t : grid.triangles) {
    for (const uint32_t corner : t) {
      texcoords.push_back(static_cast<float>(grid.points[corner][0]));
      texcoords.push_back(static_cast<float>(grid.points[corner][1]));
    }
  }
  const GivenMesh given(grid);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = texcoords.data();
  mesh.kind = TKS_OBJECT_RESAMPLED;
  const Encoded made = encodeMesh(mesh, budget(20000), &image);
  const OpenedStream decoder = opened(made.stream, made.stream.size());
  tks_info info{};
  info.size = sizeof info;
  ASSERT_EQ(tks_get_info(decoder.get(), &info), TKS_OK);
  std::vector<uint8_t> decoded(size_t{info.texture_width} * info.texture_height * 3);
  ASSERT_EQ(tks_decode_texture(decoder.get(), decoded.data(), decoded.size()), TKS_OK);
  const DecodedMesh shown = decodedMesh(decoder.get(), TKS_MESH_BUDGET, 2000);
  const double scale = std::exp2(double(info.texture_forest.depth) - double(info.forest.depth));
  for (size_t v = 0; v < shown.points.size(); ++v) {
    const double column = shown.pixels[v][0] - 0.5, row = shown.pixels[v][1] - 0.5;
    const double patch = std::floor(row / info.width), y = row - patch * info.width;
    const auto texel = static_cast<size_t>((patch * info.texture_width + std::round(y * scale)) *
                                           info.texture_width) +
                       static_cast<size_t>(std::round(column * scale));
    const auto expected = [](double place) { return std::clamp(256 * place - 2, 0.0, 252.0); };
    if (shown.points[v][0] < 0.05 || shown.points[v][0] > 0.95) continue;  // the image repeats
    if (shown.points[v][1] < 0.05 || shown.points[v][1] > 0.95) continue;
    EXPECT_NEAR(decoded[3 * texel], expected(shown.points[v][0]), 12);
    EXPECT_NEAR(decoded[3 * texel + 1], expected(shown.points[v][1]), 12);
    EXPECT_NEAR(decoded[3 * texel + 2], 128, 4);
    EXPECT_NEAR(shown.texcoords[v][0] * info.texture_width, std::round(column * scale) + 0.5, 1e-9);
    EXPECT_NEAR(shown.texcoords[v][1] * info.texture_height,
                patch * info.texture_width + std::round(y * scale) + 0.5, 1e-6);
  }
}

/// A thin box whose upper side shows noise and whose other sides are plain, and its image.
struct PaintedBox {
  static constexpr uint32_t kSide = 128;
  TriangleMesh mesh;
  std::vector<float> texcoords;
  std::vector<uint8_t> texels;

  PaintedBox() {
    uint32_t state = 1;
    for (uint32_t y = 0; y < kSide; ++y) {
      for (uint32_t x = 0; x < kSide; ++x) {
        state = state * 1664525 + 1013904223;
        for (int c = 0; c < 3; ++c)
          texels.push_back(x < kSide / 2 ? static_cast<uint8_t>(state >> (8 + 8 * c)) : 128);
      }
    }
    const TriangleMesh grid = made::openGrid(12, 12, 0.03);
    for (const bool lower : {false, true}) {
      const auto first = static_cast<uint32_t>(mesh.points.size());
      for (Point point : grid.points) {
        if (lower) point[2] -= 0.2;
        mesh.points.push_back(point);
      }
      for (Triangle t : grid.triangles) {
        if (lower) std::swap(t[1], t[2]);
        for (const uint32_t corner : t) {
          texcoords.push_back(static_cast<float>(
              (lower ? 0.5 : 0.02) + 0.46 * std::clamp(grid.points[corner][0], 0.0, 1.0)));
          texcoords.push_back(static_cast<float>(std::clamp(grid.points[corner][1], 0.0, 1.0)));
        }
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      }
    }
  }
  tks_image image() const {
    tks_image out{};
    out.size = sizeof out;
    out.width = out.height = kSide;
    out.channels = 3;
    out.sample = TKS_U8;
    out.data = texels.data();
    return out;
  }
};

tks_camera cameraAt(double z) {
  tks_camera camera{};
  camera.name = "above or below";
  camera.eye[0] = camera.target[0] = camera.eye[1] = camera.target[1] = 0.5;
  camera.eye[2] = z;
  camera.up[1] = 1;
  camera.fov_y = 40;
  camera.width = camera.height = 256;
  camera.weight = 1;
  return camera;
}

/// Bytes go to the texture where cameras see it.
TEST(ObjectStreams, AreSharedForTheirCameras) {
  const PaintedBox box;
  const GivenMesh given(box.mesh);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = box.texcoords.data();
  mesh.kind = TKS_OBJECT_RESAMPLED;
  const tks_image image = box.image();
  std::vector<uint64_t> of_texture;
  for (const double z : {3., -3.}) {
    const tks_camera camera = cameraAt(z);
    tks_encode_options options = budget(3000);
    options.cameras = &camera;
    options.camera_count = 1;
    const Encoded made = encodeMesh(mesh, options, &image);
    EXPECT_EQ(made.report.as_resampled.bytes, made.stream.size());
    EXPECT_EQ(made.report.as_triangles.bytes, 0u);
    EXPECT_GT(made.report.as_resampled.screen_psnr, 5);
    tks_info info{};
    info.size = sizeof info;
    ASSERT_EQ(tks_get_info(opened(made.stream, made.stream.size()).get(), &info), TKS_OK);
    of_texture.push_back(info.texture_bytes);
  }
  EXPECT_GT(of_texture[0], of_texture[1]);
}

TEST(ObjectStreams, TakeTheKindWhosePicturesAreBetter) {
  const PaintedBox box;
  const GivenMesh given(box.mesh);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = box.texcoords.data();
  const tks_image image = box.image();
  const Encoded made = encodeMesh(mesh, budget(8000), &image);
  const tks_object_trial &resampled = made.report.as_resampled,
                         &triangles = made.report.as_triangles;
  ASSERT_GT(resampled.bytes, 0u);
  ASSERT_GT(triangles.bytes, 0u);
  EXPECT_EQ(made.report.kind == TKS_OBJECT_TRIANGLES,
            triangles.screen_psnr > resampled.screen_psnr);
}

/// Some of the cameras around a flat mesh see its edge alone. Coordinates that are no numbers, or
/// far away, show some texel.
TEST(ObjectStreams, TakeFlatMeshesAndOddCoordinates) {
  const PaintedBox box;
  const TriangleMesh flat = made::openGrid(12, 12, 0);
  std::vector<float> texcoords(
      box.texcoords.begin(),
      box.texcoords.begin() + static_cast<ptrdiff_t>(6 * flat.triangles.size()));
  const GivenMesh given(flat);
  const tks_image image = box.image();
  for (const std::vector<float>& odd : {std::vector{0.5f}, {NAN, INFINITY, -3e38f}}) {
    for (size_t i = 0; i < texcoords.size(); i += 7) texcoords[i] = odd[i / 7 % odd.size()];
    tks_triangle_mesh mesh = given.given();
    mesh.texcoords = texcoords.data();
    const Encoded made = encodeMesh(mesh, budget(8000), &image);
    EXPECT_GT(made.report.as_resampled.bytes, 0u) << odd[0];
    EXPECT_GT(made.report.as_resampled.screen_psnr, 5) << odd[0];
  }
}

TEST(ObjectStreams, RefuseCamerasThatSeeNothing) {
  const PaintedBox box;
  const GivenMesh given(box.mesh);
  tks_triangle_mesh mesh = given.given();
  mesh.texcoords = box.texcoords.data();
  const tks_image image = box.image();
  tks_camera camera = cameraAt(3);
  camera.target[2] = 6;
  tks_encode_options options = budget(3000);
  options.cameras = &camera;
  options.camera_count = 1;
  tks_buffer buffer{};
  std::array<char, 300> message{};
  const auto encode = [&](const tks_image* texture) {
    return tks_encode_object(&mesh, texture, &options, nullptr, &buffer, message.data(),
                             message.size());
  };
  EXPECT_EQ(encode(&image), TKS_USAGE);
  EXPECT_NE(std::string(message.data()).find("sees nothing of the mesh"), std::string::npos);
  camera = cameraAt(3);
  EXPECT_EQ(encode(nullptr), TKS_USAGE);
  camera.weight = 0;
  EXPECT_EQ(encode(&image), TKS_USAGE);
  EXPECT_EQ(buffer.data, nullptr);
}

TEST(ObjectStreams, TellTheirProgressAndStop) {
  struct Told {
    double last = 0;
    bool falls = false;
    int calls = 0, most = 1 << 20;
  };
  const auto told = [](void* user, double done) {
    auto& seen = *static_cast<Told*>(user);
    seen.falls |= done < seen.last || done > 1;
    seen.last = done;
    return ++seen.calls > seen.most ? 1 : 0;
  };
  const GivenMesh sphere(made::sphere(3));
  const tks_triangle_mesh mesh = sphere.given();
  for (const int most : {1 << 20, 0}) {
    Told seen;
    seen.most = most;
    tks_encode_options options = budget(2000);
    options.progress = told;
    options.user = &seen;
    tks_buffer buffer{};
    std::array<char, 300> message{};
    const tks_status status = tks_encode_object(&mesh, nullptr, &options, nullptr, &buffer,
                                                message.data(), message.size());
    EXPECT_EQ(status, most > 0 ? TKS_OK : TKS_USAGE);
    EXPECT_STREQ(message.data(), most > 0 ? "" : "Encoding was stopped by the caller.");
    EXPECT_FALSE(seen.falls);
    tks_free_buffer(&buffer);
  }
}

TEST(ObjectStreams, OfBadMeshesAreASentence) {
  const auto refused = [](const TriangleMesh& mesh, tks_encode_options options) {
    const GivenMesh given(mesh);
    const tks_triangle_mesh in = given.given();
    tks_buffer buffer{};
    std::array<char, 300> message{};
    EXPECT_EQ(
        tks_encode_object(&in, nullptr, &options, nullptr, &buffer, message.data(), message.size()),
        TKS_USAGE);
    EXPECT_EQ(buffer.data, nullptr);
    return std::string(message.data());
  };
  const TriangleMesh sphere = made::sphere(2);
  TriangleMesh far = sphere;
  far.points[7][1] = kNan;
  EXPECT_EQ(refused(far, budget(1000)), "Vertex 7 of the mesh lies at no finite place.");
  TriangleMesh wrong = sphere;
  wrong.triangles[3][2] = 5000;
  EXPECT_EQ(refused(wrong, budget(1000)),
            "Triangle 3 of the mesh names vertex 5000, which is not there.");
  EXPECT_EQ(refused({}, budget(1000)), "The mesh has no triangles.");
  EXPECT_EQ(refused({{{0, 0, 0}}, {{0, 0, 0}}}, budget(1000)),
            "No triangle of the mesh is left: all have corners at equal places.");
  EXPECT_NE(refused(sphere, lossless()).find("cannot be lossless"), std::string::npos);
  EXPECT_NE(refused(sphere, budget(30)).find("too small"), std::string::npos);
}

TEST(ObjectStreams, TakeAnyTrianglesThatFitTogetherOrNot) {
  std::mt19937 random(5);
  const std::vector<TriangleMesh> meshes = {
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}}},
      {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}},
      {{{0, 0, 0}, {1e-30, 0, 0}, {0, 1e-30, 0}}, {{0, 1, 2}}},
      {{{-1e30, 0, 0}, {1e30, 0, 0}, {0, 1e30, 0}}, {{0, 1, 2}}},
      made::moebiusStrip(20),
      made::soup(random, 20, 60),
      made::beside(made::sphere(2), made::torus(12, 8), {4, 0, 0})};
  for (size_t i = 0; i < meshes.size(); ++i) {
    const Encoded made = encodeMesh(meshes[i], budget(2000));
    const OpenedStream decoder = opened(made.stream, made.stream.size());
    const DecodedMesh mesh = decodedMesh(decoder.get(), TKS_MESH_BUDGET, 5000);
    EXPECT_GT(mesh.triangles.size(), 0u) << "mesh " << i;
    for (const auto& point : mesh.points)
      for (const double value : point) ASSERT_TRUE(std::isfinite(value)) << "mesh " << i;
  }
}

}  // namespace
}  // namespace tetrakis::test
