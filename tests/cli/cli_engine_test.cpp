// SPDX-License-Identifier: Apache-2.0
// What `decode` writes for engines: compressed meshes, normals, heights with their scales.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

TEST_F(CliTest, HeightsForEnginesComeWithTheirScales) {
  makeStream();
  const Outcome unreal = cli("decode a.tks --height u.r16 --size unreal:127 --json");
  ASSERT_EQ(unreal.code, 0) << unreal.err;
  EXPECT_EQ(content("u.r16").size(), 127U * 127 * 2);
  const auto json = nlohmann::json::parse(unreal.out);
  const double range = json["highest"].get<double>() - json["lowest"].get<double>();
  EXPECT_NEAR(json["scale_z"], range * 100 / 512 * 65536 / 65535, 1e-9);
  EXPECT_NEAR(json["scale_x"], 16 * 30 * 100 / 126.0, 1e-9);
  const Outcome unity = cli("decode a.tks --height u.raw --size unity");
  ASSERT_EQ(unity.code, 0) << unity.err;
  EXPECT_EQ(content("u.raw").size(), 33U * 33 * 2);
  EXPECT_NE(unity.err.find("33 x 33 for Unity"), std::string::npos) << unity.err;
  EXPECT_EQ(cli("decode a.tks -q -f --height u.raw --size unity").err, "");
  EXPECT_EQ(cli("decode a.tks --height - --size unity").out, content("u.raw"));
}

TEST_F(CliTest, TexturesForEnginesAreTurnedAsTheHeights) {
  tools::HeightFile north_up = hills(17), east_first = north_up;
  north_up.geotransform = {400000, 30, 0, 3800000, 0, -30};
  east_first.geotransform = {400000, 0, 30, 3800000, -30, 0};  // rows are columns
  north_up.crs = east_first.crs = "EPSG:32611";
  tools::ImageFile picture{5, 3, 1, TKS_U8, {}}, transposed{3, 5, 1, TKS_U8, {}};
  for (uint32_t i = 0; i < 15; ++i) {
    picture.data.push_back(static_cast<std::byte>(i));
    transposed.data.push_back(static_cast<std::byte>(i % 3 * 5 + i / 3));
  }
  const auto texture = [&](const tools::HeightFile& heights, const tools::ImageFile& image) {
    EXPECT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
    EXPECT_TRUE(tools::writeImage(path("t.png"), image).ok());
    EXPECT_EQ(cli("encode h.tif --texture t.png --lossless -f -o a.tks").code, 0);
    const Outcome run = cli("decode a.tks -f --height u.r16 --size unreal:127 --texture u.png");
    EXPECT_EQ(run.code, 0) << run.err;
    return tools::readImage(path("u.png"));
  };
  for (const auto& [heights, image] : {std::pair(north_up, picture), {east_first, transposed}}) {
    const auto out = texture(heights, image);
    ASSERT_TRUE(out.ok());
    EXPECT_EQ(out->width, 5U);
    EXPECT_EQ(out->data, picture.data);
  }
}

TEST_F(CliTest, WhatIsGuessedOfTheGroundIsTold) {
  tools::HeightFile bare = hills(17);
  bare.unit = "";
  bare.spacing_x = bare.spacing_y = 0;
  ASSERT_TRUE(tools::writeHeights(path("bare.tif"), bare).ok());
  ASSERT_EQ(cli("encode bare.tif --lossless -o bare.tks").code, 0);
  for (const char* output : {"--mesh m.glb", "--normal-map n.png", "--height u.r16 --size unity"}) {
    const Outcome run = cli(std::string("decode bare.tks ") + output);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("spacing of its samples, which counts as 30 m"), std::string::npos);
    EXPECT_NE(run.err.find("unit of its heights, which counts as metres"), std::string::npos);
    EXPECT_EQ(cli(std::string("-q decode -f bare.tks ") + output).err, "");
  }
  EXPECT_EQ(cli("decode bare.tks --height h.tif").err, "");
  ASSERT_EQ(cli("-q encode bare.tif --unit degC --spacing 30 --lossless -o warm.tks").code, 0);
  EXPECT_EQ(cli("decode warm.tks --mesh warm.glb").err,
            "note: the unit of the heights, 'degC', is no length and counts as metres\n");
}

/// Mip levels end before ground does whose side is no multiple of their spacing.
TEST_F(CliTest, SmallLandscapesCoverTheGround) {
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), hills(100)).ok());
  ASSERT_EQ(cli("-q encode h.tif --lossless -o h.tks").code, 0);
  for (const char* size : {"unity:33", "unity:65", "unity:129"}) {
    const Outcome run = cli(std::string("decode h.tks -f --json --height u.raw --size ") + size);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NEAR(nlohmann::json::parse(run.out)["width"], 99 * 30, 1e-9) << size;
  }
}

TEST_F(CliTest, OptionsForEnginesThatDoNotGoTogetherAreRefused) {
  makeStream();
  for (const char* wrong :
       {"--height u.png --size unity", "--height u.tif --size unreal", "--height u.r16",
        "--height u.r16 --size unity:512", "--height u.r16 --size godot", "--size unity",
        "--height u.r16 --size unity --level 1", "--height u.r16 --size unity --window 0,0,4,4",
        "--height - --size unity --json", "--height u.tif --json",
        "--texture t.png --compress draco", "--mesh m.ply --compress draco",
        "--mesh m.obj --mesh-texture webp", "--mesh m.glb --compress zip", "--normal-map n.xyz",
        "--normal-map n.png --window 0,0,4,4", "--normal-map n.png --texture n.png"}) {
    const Outcome run = cli(std::string("decode a.tks ") + wrong);
    EXPECT_EQ(run.code, 1) << wrong;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_EQ(names(), (std::set<std::string>{"a.tks", "height.tif", "texture.png"}));
  EXPECT_EQ(cli("decode a.tks --mesh missing/m.glb --compress draco").code, 2);
  EXPECT_EQ(cli("decode a.tks --normal-map missing/n.png").code, 2);
  EXPECT_EQ(cli("decode a.tks --height missing/u.r16 --size unity").code, 2);
}

TEST_F(CliTest, NormalMapsAreBlueUpRedEastGreenNorth) {
  tools::HeightFile slope = hills(17);  // rises by 3 m to the east and by 1 m to the north
  for (uint32_t i = 0; i < 17 * 17; ++i) {
    const auto sample = static_cast<uint16_t>(1000 + 300 * (i % 17) - 100 * (i / 17) + 1600);
    std::memcpy(&slope.data[2 * i], &sample, 2);
  }
  ASSERT_TRUE(tools::writeHeights(path("slope.tif"), slope).ok());
  ASSERT_EQ(cli("encode slope.tif --lossless -o s.tks").code, 0);
  ASSERT_EQ(cli("decode s.tks --normal-map n.png").code, 0);
  const auto map = tools::readImage(path("n.png"));
  ASSERT_TRUE(map.ok());
  ASSERT_EQ(map->width, 17U);
  const double length = std::hypot(1, 1, 1.0 / 3);  // 30 m rise over 30 m east, 10 m over 30 north
  for (size_t i = 0; i < map->data.size(); i += 3) {
    EXPECT_NEAR(int(map->data[i]), (1 - 1 / length) / 2 * 255, 1);
    EXPECT_NEAR(int(map->data[i + 1]), (1 - 1.0 / 3 / length) / 2 * 255, 1);
    EXPECT_NEAR(int(map->data[i + 2]), (1 + 1 / length) / 2 * 255, 1);
  }
}

TEST_F(CliTest, FewTrianglesHaveTheNormalsOfTheWholeSurface) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --mesh all.ply").code, 0);
  ASSERT_EQ(cli("decode a.tks --mesh few.ply --triangles 20").code, 0);
  const auto vertices = [this](const std::string& name) {
    const std::string file = content(name);
    const size_t body = file.find("end_header\n") + 11;
    const size_t count = std::stoul(file.substr(file.find("vertex ") + 7));
    std::map<std::pair<float, float>, std::array<float, 3>> normals;
    for (size_t i = 0; i < count; ++i) {
      std::array<float, 8> values;
      std::memcpy(values.data(), file.data() + body + 32 * i, 32);
      normals[{values[0], values[2]}] = {values[3], values[4], values[5]};
    }
    return normals;
  };
  const auto all = vertices("all.ply");
  for (const auto& [place, normal] : vertices("few.ply")) EXPECT_EQ(normal, all.at(place));
}

}  // namespace
}  // namespace tetrakis::test
