// SPDX-License-Identifier: Apache-2.0
// tks_decode_screen_mesh: every prefix, voids, and what it refuses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/mesh_checks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// From the south: rows farther off are smaller, and 10^5 steps of height move the ground by half
/// of the picture.
tks_screen_camera cameraOver(uint32_t width, uint32_t height) {
  tks_screen_camera camera = {};
  camera.size = sizeof camera;
  camera.width = 96;
  camera.height = 64;
  const double clip[16] = {2.0 / width, 0, 0, -1, 0,   -1.0 / height, 1e-5, 0.5,
                           0,           0, 0, 0,  0.0, -0.3 / height, 0,    1.5};
  std::copy(clip, clip + 16, camera.clip);
  return camera;
}

struct SeenMesh {
  tks_status status = TKS_OK;
  std::string message;
  LatticeMesh mesh;
  std::vector<float> heights;
};

SeenMesh decode(Stream& stream, const tks_screen* screen, uint32_t triangles) {
  tks_mesh mesh = {};
  SeenMesh drawn;
  drawn.status = tks_decode_screen_mesh(stream.get(), screen, triangles, &mesh);
  drawn.message = tks_message(stream.get());
  drawn.mesh.vertices.assign(mesh.grid_index, mesh.grid_index + mesh.vertex_count);
  drawn.mesh.triangles.assign(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count});
  drawn.heights.assign(mesh.height, mesh.height + mesh.vertex_count);
  tks_free_mesh(&mesh);
  return drawn;
}

class ScreenMeshStream : public testing::Test {
 protected:
  Raster heights_ = make({Pattern::kRidges, 60, 47, 1, TKS_U16, 3});
  Bytes bytes_ = encode(&heights_, nullptr, lossless());
  tks_screen_camera camera_ = cameraOver(60, 47);
  std::array<uint8_t, 4> texels_ = {0, 200, 90, 10};
  tks_image image_ = {};
  tks_screen screen_ = {sizeof(tks_screen), &camera_, 1, nullptr};

  ScreenMeshStream() {
    image_.size = sizeof image_;
    image_.width = image_.height = 2;
    image_.channels = 1;
    image_.data = texels_.data();
  }
};

TEST_F(ScreenMeshStream, EveryPrefixGivesAMeshOfNoMoreTriangles) {
  screen_.texture = &image_;
  Stream whole(bytes_);
  const size_t header = whole.info().header_bytes;
  for (size_t size = header; size <= bytes_.size(); size += 1 + size / 12) {
    Stream stream(Prefix(bytes_).first(size));
    for (const tks_screen* screen : {&screen_, static_cast<tks_screen*>(nullptr)}) {
      const SeenMesh drawn = decode(stream, screen, 150);
      ASSERT_EQ(drawn.status, TKS_OK) << drawn.message;
      EXPECT_LE(drawn.mesh.triangleCount(), 150u);
      checks::expectConforming(drawn.mesh, 60, 47);
      for (const float height : drawn.heights) EXPECT_TRUE(std::isfinite(height));
    }
  }
}

TEST_F(ScreenMeshStream, TwoCamerasOfOneWeightAreTheSameInAnyOrder) {
  Stream stream(bytes_);
  tks_screen_camera beside = camera_;
  beside.clip[3] = -2;
  std::array<tks_screen_camera, 2> both = {camera_, beside};
  screen_ = {sizeof screen_, both.data(), 2, nullptr};
  const SeenMesh one = decode(stream, &screen_, 200);
  std::swap(both[0], both[1]);
  const SeenMesh other = decode(stream, &screen_, 200);
  EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
  EXPECT_EQ(one.heights, other.heights);
  both[0].weight = both[1].weight = 7;
  EXPECT_EQ(decode(stream, &screen_, 200).mesh.vertices, one.mesh.vertices);
}

TEST_F(ScreenMeshStream, CamerasThatSeeNothingAreAsIfThereWereNone) {
  Stream stream(bytes_);
  camera_.clip[15] = -4;
  EXPECT_EQ(decode(stream, &screen_, 200).heights, decode(stream, nullptr, 200).heights);
}

TEST_F(ScreenMeshStream, RefusesWithASentence) {
  Stream stream(bytes_);
  const auto refused = [&](const char* part, uint32_t triangles = 100) {
    const SeenMesh drawn = decode(stream, &screen_, triangles);
    EXPECT_EQ(drawn.status, TKS_USAGE) << part;
    EXPECT_NE(drawn.message.find(part), std::string::npos) << drawn.message;
    EXPECT_TRUE(drawn.mesh.vertices.empty());
  };
  refused("triangle", 0);
  const tks_screen_camera sound = camera_;
  camera_.clip[5] = std::numeric_limits<double>::quiet_NaN();
  refused("camera 1 of 1");
  camera_ = sound;
  camera_.weight = -1;
  refused("weight");
  camera_ = sound;
  camera_.width = 0;
  refused("picture");
  camera_ = sound;
  camera_.size = 12;
  refused("size");
  camera_ = sound;
  screen_.texture = &image_;
  image_.channels = 5;
  refused("channels");
  image_.channels = 1;
  image_.data = nullptr;
  refused("texture");
  screen_.texture = nullptr;
  screen_.cameras = nullptr;
  refused("missing");
  screen_.camera_count = 0;
  EXPECT_EQ(decode(stream, &screen_, 100).status, TKS_OK);
  EXPECT_EQ(tks_decode_screen_mesh(stream.get(), nullptr, 100, nullptr), TKS_USAGE);
}

TEST_F(ScreenMeshStream, TouchesNoVoid) {
  auto* samples = reinterpret_cast<uint16_t*>(heights_.data.data());
  for (size_t i = 0; i < 60 * 47; ++i)
    if (i % 60 < 25 && i / 60 > 20) samples[i] = 0;
  tks_heights given = heights_.heights();
  given.has_nodata = 1;
  const Bytes bytes = encodeHeights(given, lossless());
  Stream stream(bytes);
  for (const uint32_t triangles : {10u, 100u, 900u}) {
    const SeenMesh drawn = decode(stream, &screen_, triangles);
    ASSERT_EQ(drawn.status, TKS_OK) << drawn.message;
    EXPECT_LE(drawn.mesh.triangleCount(), triangles);
    EXPECT_GT(drawn.mesh.triangleCount(), 0u);
    for (const uint32_t v : drawn.mesh.vertices) EXPECT_NE(samples[v], 0);
  }
}

}  // namespace
}  // namespace tetrakis::test
