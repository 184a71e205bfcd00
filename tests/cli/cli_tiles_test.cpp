// SPDX-License-Identifier: Apache-2.0
// Terrain tiles: they cover the globe's quadtree without gaps or overlaps, share their edges to the
// bit, and have the heights of the stream.
#include <cmath>
#include <limits>

#include "tests/cli/cli_tiles_fixture.hpp"

namespace tetrakis::test {
namespace {

TEST_F(CliTiles, CoverTheGroundAndShareTheirEdges) {
  // The last two end at the pole, and count longitudes from 0 to 360.
  for (const auto& [west, south] :
       {std::pair(7.31, 46.2), {-0.05, -0.04}, {-179.9, 88.0}, {7.31, 89.93}, {350.1, 46.2}}) {
    encode(ramp(130, 70, west, south));
    const Outcome run = cli("tiles s.tks -f -o t");
    ASSERT_EQ(run.code, 0) << run.err;
    const auto tiles = readTiles("t");
    EXPECT_NE(run.err.find(std::to_string(tiles.size()) + " tiles"), std::string::npos) << run.err;
    expectSound(tiles);
  }
}

TEST_F(CliTiles, GridsWithSamplesOnPolesAndAntimeridianAreTaken) {
  const auto tile = [this](const tools::GeoTransform& transform, uint32_t width, uint32_t height) {
    tools::HeightFile file = ramp(width, height, 0, 0);
    file.geotransform = transform;
    encode(file);
    const Outcome run = cli("-q tiles s.tks -f -o t");
    EXPECT_EQ(run.code, 0) << run.err;
    auto tiles = readTiles("t");
    expectSound(tiles);
    return tiles;
  };
  // The Earth from pole to pole: from -180 to 180, and from 0 to 359.
  for (const auto& [west, columns] : {std::pair(-180.5, 361U), {-0.5, 360U}}) {
    const auto tiles = tile({west, 1, 0, 90.5, 0, -1}, columns, 181);
    for (const auto& item : tiles) {
      for (size_t i = 0; i < item.second.u.size(); ++i)
        EXPECT_GT(item.second.metres(i), 900) << item.first[0];
    }
  }
  // What begins, and what ends, with the antimeridian.
  tile({179.9995, 0.001, 0, 10, 0, -0.001}, 30, 30);
  tile({179.9705, 0.001, 0, 10, 0, -0.001}, 30, 30);
}

TEST_F(CliTiles, HaveTheHeightsOfTheStreamAtTheRightPlace) {
  encode(ramp(130, 110, 7.31, 46.2));
  ASSERT_EQ(cli("-q tiles s.tks -o t").code, 0);
  const auto tiles = readTiles("t");
  const uint32_t deepest = tiles.rbegin()->first[0];
  size_t seen = 0;
  for (const auto& item : tiles) {
    const double side = 180 / std::pow(2, item.first[0]);
    for (size_t i = 0; i < item.second.u.size() && item.first[0] == deepest; ++i) {
      const double x = (item.first[1] + item.second.u[i] / 32767.0) * side - 180 - 7.31;
      const double y = (item.first[2] + item.second.v[i] / 32767.0) * side - 90 - 46.2;
      const bool in = x > 0.001 && x < 0.129 && y > 0.001 && y < 0.109;
      const bool out = x < -0.0001 || x > 0.1301 || y < -0.0001 || y > 0.1101;
      if (in) {
        EXPECT_NEAR(item.second.metres(i), 1000 + 4000 * x + 9000 * y, 0.15);
      }
      if (out) {
        EXPECT_EQ(item.second.metres(i), 0);
      }
      seen += in;
    }
  }
  EXPECT_GT(seen, 50U);
}

TEST_F(CliTiles, TakeProjectedGroundVoidsAndTheLeastOfTerrains) {
  tools::HeightFile utm = ramp(40, 30, 500000, 4000000);
  utm.crs = "EPSG:32611";
  utm.geotransform = tools::GeoTransform{380000, 30, 2, 3810000, 1, -30};  // turned a little
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < 400; ++i) std::memcpy(&utm.data[4 * i], &none, 4);
  encode(utm);
  ASSERT_EQ(cli("-q tiles s.tks -o utm").code, 0);
  expectSound(readTiles("utm"));
  encode(ramp(2, 2, 7, 46));
  ASSERT_EQ(cli("-q tiles s.tks -o least").code, 0);
  expectSound(readTiles("least"));
  ASSERT_EQ(cli("-q tiles s.tks --bytes 200 -f -o least").code, 0);
  expectSound(readTiles("least"));
  ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles -f -o least").code, 0);
  EXPECT_EQ(json::parse(content("least/tileset.json"))["asset"]["version"], "1.1");
  EXPECT_FALSE(std::filesystem::exists(path("least/layer.json")));
}

TEST_F(CliTiles, WhatHasNoPlaceOnAGlobeIsRefused) {
  makeStream();
  const auto refused = [this](const std::string& arguments, int code) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, code) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  refused("tiles a.tks -o t", 1);
  tools::HeightFile file = ramp(9, 9, 7, 46);
  for (const char* crs : {"EPSG:1", "somewhere", "EPSG:5703", ""}) {
    file.crs = crs;
    encode(file);
    refused("tiles s.tks -o t", 1);
  }
  encode(ramp(9, 9, 179.995, 46));  // to 180.004
  refused("tiles s.tks -o t", 1);
  // Poles inside and in a corner; zones of UTM, and maps around a pole, that cross 180 degrees by
  // much, by less than a sample, in a corner.
  using Transform = tools::GeoTransform;
  for (const auto& [crs, transform] :
       {std::pair("EPSG:3031", Transform{-45e3, 1e4, 0, 45e3, 0, -1e4}),
        {"EPSG:3031", {-1e4, 1e4, 0, 8e4, 0, -1e4}},
        {"EPSG:3413", {-5e3, 1e3, 0, 4e3, 0, -1e3}},
        {"EPSG:32701", {180.5e3, 500, 0, 8001e3, 0, -500}},
        {"EPSG:32660", {832e3, 500, 0, 30e3, 0, -500}},
        {"EPSG:32601", {166.05e3, 30, 0, 200e3, 0, -30}},
        {"EPSG:32760", {829e3, 1e3, 40, 9964e3, 40, -1e3}},
        {"EPSG:3031", {-45e3, 1e4, 0, -1e6, 0, -1e4}}}) {
    file.crs = crs;
    file.geotransform = transform;
    encode(file);
    const Outcome run = cli("tiles s.tks -o t");
    EXPECT_EQ(run.code, 1) << crs << ' ' << transform[0];
    EXPECT_NE(run.err.find("both sides of the antimeridian"), std::string::npos) << run.err;
  }
  ASSERT_EQ(cli("-q encode --texture texture.png --lossless -o image.tks").code, 0);
  refused("tiles image.tks -o t", 1);
  refused("tiles a.tks -o t --format zip", 1);
  refused("tiles a.tks", 1);
  EXPECT_FALSE(std::filesystem::exists(path("t")));
}

TEST_F(CliTiles, GroundStaysInSight) {
  // The second is thinner than cells of all but the deepest levels.
  for (const auto& [width, height] : {std::pair(130U, 110U), {3U, 700U}}) {
    encode(ramp(width, height, 7.31, 46.2));
    ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles -f -o t").code, 0);
    const json tileset = json::parse(content("t/tileset.json"));
    constexpr double kMetres = 0.001 * 77000;  // from west to east, at least
    for (const json& error : {tileset["geometricError"], tileset["root"]["geometricError"]})
      EXPECT_GE(error.get<double>(), kMetres * std::hypot(width, height));
    ASSERT_TRUE(tileset["root"].contains("children"));
    std::vector<json> tiles = tileset["root"]["children"];
    size_t contents = 0;
    while (!tiles.empty()) {
      const json tile = tiles.back();
      tiles.pop_back();
      ASSERT_TRUE(tile.contains("content"));
      ++contents;
      for (const json& child : tile.value("children", json::array())) {
        EXPECT_LT(child["geometricError"], tile["geometricError"]);
        tiles.push_back(child);
      }
    }
    size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("t")))
      files += entry.path().extension() == ".glb";
    EXPECT_EQ(contents, files);
  }
}

TEST_F(CliTiles, VoidsAreNoGround) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  tools::HeightFile file = ramp(40, 30, 7.31, 46.2);
  for (size_t i = 0; i < 40 * 30; ++i) std::memcpy(&file.data[4 * i], &none, 4);
  for (const char* format : {"quantized-mesh", "3dtiles"}) {
    encode(file);
    for (const char* bytes : {"", "--bytes 150 "}) {
      const Outcome run = cli("tiles s.tks " + std::string(bytes) + "-o t --format " + format);
      EXPECT_EQ(run.code, 1);
      EXPECT_NE(run.err.find("there is no ground"), std::string::npos) << run.err;
    }
    EXPECT_EQ(names(), (std::set<std::string>{"h.tif", "s.tks"}));
  }
}

TEST_F(CliTiles, FoldersAppearWholeAndAreNotOverwritten) {
  encode(ramp(9, 9, 7, 46));
  ASSERT_EQ(cli("-q tiles s.tks -o t/").code, 0);
  const std::string layer = content("t/layer.json");
  EXPECT_EQ(cli("tiles s.tks -o t").code, 2);
  EXPECT_EQ(cli("-q tiles s.tks -f -o t").code, 0);
  EXPECT_EQ(content("t/layer.json"), layer);
  EXPECT_EQ(cli("tiles s.tks -f -o .").code, 2);
  EXPECT_EQ(cli("tiles s.tks -f -o s.tks").code, 2);
  EXPECT_EQ(cli("tiles s.tks -o missing/t").code, 2);
  std::filesystem::create_directory(path("empty"));
  EXPECT_EQ(cli("-q tiles s.tks -o empty").code, 0);
  EXPECT_EQ(content("empty/layer.json"), layer);
  EXPECT_EQ(names(), (std::set<std::string>{"empty", "h.tif", "s.tks", "t"}));
}

}  // namespace
}  // namespace tetrakis::test
