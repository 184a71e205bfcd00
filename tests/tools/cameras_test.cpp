// SPDX-License-Identifier: Apache-2.0
// Preset cameras, and cameras that files describe.
#include "codec/ground/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <utility>

#include "apps/tools/render/projection.hpp"
#include "apps/tools/render/render.hpp"

namespace tetrakis::tools {
namespace {

struct Clip {
  double x, y, z, w;
  bool inPicture() const { return w > 0 && std::abs(x) <= w && std::abs(y) <= w; }
};

Clip project(const std::array<float, 16>& m, double x, double y, double z) {
  const auto row = [&](size_t r) { return m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r]; };
  return {row(0), row(1), row(2), row(3)};
}

double mixOf(const Bounds& b, size_t axis, double t) {
  return b.low[axis] + (b.high[axis] - b.low[axis]) * t;
}

const std::vector<Bounds> kTerrains = {
    {{-7680, 0, -7680}, {7680, 1200, 7680}},     {{-3000, 148, -5200}, {3000, 709, 5200}},
    {{-50000, -20, -8000}, {50000, 3000, 8000}}, {{-1, 0, -1}, {1, 0, 1}},
    {{-15, -400, -15}, {15, 6000, 15}},
};

TEST(Cameras, ObliqueAndTopSeeAllOfTheTerrain) {
  for (const Bounds& terrain : kTerrains) {
    for (const char* view : {"oblique", "top"}) {
      const Result<std::vector<Camera>> cameras = presetCameras(view, terrain);
      ASSERT_TRUE(cameras.ok());
      ASSERT_EQ(cameras->size(), 1u);
      const std::array<float, 16> matrix = projectionOf((*cameras)[0], terrain);
      double widest = 0;
      for (int i = 0; i < 8; ++i) {
        const Clip clip = project(matrix, mixOf(terrain, 0, i & 1), mixOf(terrain, 1, i >> 1 & 1),
                                  mixOf(terrain, 2, i >> 2));
        EXPECT_TRUE(clip.inPicture()) << view << i;
        EXPECT_LE(std::abs(clip.z), 1.001 * clip.w) << view << i;
        widest = std::max({widest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
      }
      EXPECT_GT(widest, 0.95) << view;  // and it fills the picture
    }
  }
}

TEST(Cameras, LowStandsAboveTheGroundAndSeesATenth) {
  for (size_t i = 0; i < 3; ++i) {
    const Bounds& terrain = kTerrains[i];
    const Result<std::vector<Camera>> cameras = presetCameras("low", terrain);
    ASSERT_TRUE(cameras.ok());
    const Camera& camera = (*cameras)[0];
    EXPECT_GT(camera.eye[1], terrain.high[1]);
    EXPECT_GT(camera.eye[2], terrain.low[2]);
    EXPECT_LE(camera.eye[2], terrain.high[2] + 1);
    const std::array<float, 16> matrix = projectionOf(camera, terrain);
    const double middle = (terrain.low[1] + terrain.high[1]) / 2;
    int seen = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x)
        seen += project(matrix, mixOf(terrain, 0, (x + 0.5) / 100), middle,
                        mixOf(terrain, 2, (y + 0.5) / 100))
                    .inPicture();
    EXPECT_NEAR(seen / 10000.0, 0.1, 0.015);
    const Clip border = project(matrix, camera.eye[0], middle, terrain.low[2]);
    EXPECT_NEAR(border.y / border.w, 0.6, 1e-3);  // the rest above is sky
  }
}

TEST(Cameras, AllIsTheThreeViewsAndOthersAreRefused) {
  const Result<std::vector<Camera>> all = presetCameras("all", kTerrains[0]);
  ASSERT_TRUE(all.ok());
  ASSERT_EQ(all->size(), 3u);
  EXPECT_EQ((*all)[0].name, "oblique");
  EXPECT_EQ((*all)[1].name, "low");
  EXPECT_EQ((*all)[2].name, "top");
  const Result<std::vector<Camera>> any = presetCameras("any", kTerrains[0]);
  ASSERT_TRUE(any.ok());
  double weights = 0;
  for (const Camera& camera : *any) weights += camera.weight;
  EXPECT_EQ(any->size(), 9u);  // two views from four sides, and the top view
  EXPECT_EQ(weights, 3);
  EXPECT_EQ(presetCameras("sideways", kTerrains[0]).status().code(), TKS_USAGE);
  Bounds nowhere;
  nowhere.low[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(presetCameras("top", nowhere).status().code(), TKS_USAGE);
}

class CameraFiles : public testing::Test {
 protected:
  ~CameraFiles() override { std::filesystem::remove(path_); }

  Result<std::vector<Camera>> read(const std::string& text) {
    std::ofstream(path_) << text;
    return readCameras(path_);
  }

  const std::string path_ =
      (std::filesystem::temp_directory_path() /
       ("tetrakis_cameras_" + std::to_string(std::random_device()()) + ".json"))
          .string();
};

TEST_F(CameraFiles, GivesWhatIsWrittenAndDefaultsElsewhere) {
  const Result<std::vector<Camera>> cameras = read(
      R"({"cameras": [{"eye": [1, 2, 3], "target": [0, 0.5, -1]},
                      {"name": "b", "eye": [0, 9, 0], "target": [0, 0, 0], "up": [0, 0, -1],
                       "fov_y": 20, "width": 100, "height": 8192}]})");
  ASSERT_TRUE(cameras.ok()) << cameras.status().message();
  ASSERT_EQ(cameras->size(), 2u);
  const Camera &a = (*cameras)[0], &b = (*cameras)[1];
  EXPECT_EQ(a.eye, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(a.target, (std::array<double, 3>{0, 0.5, -1}));
  EXPECT_EQ(a.up, (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(a.fov_y, 40);
  EXPECT_EQ(a.width, 768u);
  EXPECT_EQ(a.height, 512u);
  EXPECT_EQ(b.name, "b");
  EXPECT_EQ(b.up, (std::array<double, 3>{0, 0, -1}));
  EXPECT_EQ(b.fov_y, 20);
  EXPECT_EQ(b.width, 100u);
  EXPECT_EQ(b.height, 8192u);
}

TEST_F(CameraFiles, SaysWhichFieldIsWrong) {
  const std::string eye = R"("eye": [0, 5, 0], )", target = R"("target": [0, 0, 1])";
  const std::pair<std::string, const char*> cases[] = {
      {target, "eye"},
      {eye + R"("target": [0, 1])", "target"},
      {eye + R"("target": [0, "1", 2])", "target"},
      {eye + R"("target": [0, 5, 0])", "target"},
      {eye + R"("target": [0, 0, 0])", "up"},
      {eye + target + R"(, "up": [0, 0, 0])", "up"},
      {eye + target + R"(, "fov_y": 0)", "fov_y"},
      {eye + target + R"(, "fov_y": 180)", "fov_y"},
      {eye + target + R"(, "width": 0)", "width"},
      {eye + target + R"(, "width": -4)", "width"},
      {eye + target + R"(, "height": 8193)", "height"},
      {eye + target + R"(, "height": 10.5)", "height"},
      {eye + target + R"(, "name": 7)", "name"},
      {eye + target + R"(, "weight": -1)", "weight"},
      {eye + target + R"(, "weigth": 1)", "\"weigth\" is no field"},
      {eye + target + R"(, "fov": 60, "up": [0, 1, 0])", "\"fov\" is no field"},
  };
  for (const auto& [fields, culprit] : cases) {
    const Result<std::vector<Camera>> cameras = read(R"({"cameras": [{)" + fields + "}]}");
    ASSERT_FALSE(cameras.ok()) << fields;
    EXPECT_EQ(cameras.status().code(), TKS_USAGE) << fields;
    EXPECT_NE(cameras.status().message().find(culprit), std::string::npos)
        << cameras.status().message();
  }
  for (const char* text : {"", "{", "[]", "{}", R"({"cameras": []})", R"({"cameras": [4]})"})
    EXPECT_EQ(read(text).status().code(), TKS_USAGE) << text;
}

TEST_F(CameraFiles, SaysWhereItIsNoJson) {
  const std::pair<const char*, std::string> cases[] = {
      {" \n", "' is empty: it must be JSON with a list \"cameras\""},
      {"{\n\"cameras\": [\n}", "' is not JSON from line 3 on"},
      {R"({"cameras": [1e999]})", "' holds a number that is too large to be read"}};
  for (const auto& [text, sentence] : cases)
    EXPECT_EQ(read(text).status().message(), "'" + path_ + sentence);
}

TEST_F(CameraFiles, SaysWhenThereIsNone) {
  EXPECT_EQ(readCameras(path_).status().code(), TKS_IO);
}

}  // namespace
}  // namespace tetrakis::tools
