// SPDX-License-Identifier: Apache-2.0
// Which rasters the command line takes for cylinders, by where they lie.
#include "tests/cli/cli_globe_fixture.hpp"

namespace tetrakis::test {
namespace {

TEST_F(CliDomain, GeographicGridsOf360DegreesAreCylinders) {
  for (const auto& [width, west] : {std::pair{36u, -180.}, {36u, 0.}, {37u, -180.}, {1080u, 20.}}) {
    ASSERT_EQ(encode(ground(width, west, 360. / width, "EPSG:4326")).code, 0);
    EXPECT_EQ(domainOf(), "cylinder") << width;
  }
  // As a file may write a third of a degree.
  ASSERT_EQ(encode(ground(1080, -180, 0.33333333, "EPSG:4979")).code, 0);
  EXPECT_EQ(domainOf(), "cylinder");
  tools::HeightFile south_up = ground(36, -180, 10, "EPSG:4326");
  (*south_up.geotransform)[5] = 10;
  ASSERT_EQ(encode(south_up).code, 0);
  EXPECT_EQ(domainOf(), "cylinder");
}

TEST_F(CliDomain, OthersArePlanes) {
  struct Grid {
    uint32_t width;
    double west, degrees;
    const char* crs;
  };
  for (const Grid& grid :
       {Grid{3599, -180, 0.1, "EPSG:4326"}, Grid{90, 0, 1, "EPSG:4326"}, Grid{36, -180, 10, ""},
        Grid{36, -180, 10, "EPSG:3857"}, Grid{720, -180, 1, "EPSG:4326"}}) {
    const Outcome run = encode(ground(grid.width, grid.west, grid.degrees, grid.crs));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err.find("cylinder"), std::string::npos) << run.err;
    EXPECT_EQ(domainOf(), "plane") << grid.width;
  }
}

TEST_F(CliDomain, AColumnThatIsThereTwiceIsTold) {
  for (const auto& [width, west, degrees] :
       {std::tuple{361u, -180.5, 1.}, {18001u, -180.02, 0.02}}) {
    const Outcome run = encode(ground(width, west, degrees, "EPSG:4326"));
    EXPECT_NE(run.err.find("-srcwin 0 0 " + std::to_string(width - 1)), std::string::npos)
        << run.err;
    EXPECT_EQ(domainOf(), "plane");
  }
}

TEST_F(CliDomain, APartOfAColumnThatLacksOrOverlapsIsTold) {
  for (const double all : {359.9, 360.02}) {
    const Outcome run = encode(ground(360, -180, all / 360, "EPSG:4326"));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("--domain cylinder closes it"), std::string::npos) << run.err;
    EXPECT_EQ(domainOf(), "plane");
  }
}

TEST_F(CliDomain, IsWhatTheUserSays) {
  const tools::HeightFile world = ground(36, -180, 10, "EPSG:4326");
  ASSERT_EQ(encode(world, " --domain plane").code, 0);
  EXPECT_EQ(domainOf(), "plane");
  const Outcome repeating = encode(ground(361, -180.5, 1, "EPSG:4326"), " --domain cylinder");
  ASSERT_EQ(repeating.code, 0);
  EXPECT_EQ(repeating.err.find("note"), std::string::npos) << repeating.err;
  EXPECT_EQ(domainOf(), "cylinder");
  EXPECT_EQ(encode(world, " --domain sphere").code, 1);
}

/// Rows of a geographic grid have latitudes, whether they run south or north; others have none.
TEST_F(CliDomain, TheGroundOfAGlobeComesFirst) {
  const auto ordered = [&](double north, double degrees, const char* crs) {
    tools::HeightFile file = ground(128, -180, 360. / 128, crs);
    file.data.clear();
    file.height = 64;
    for (uint32_t i = 0; i < 128 * 64; ++i)
      appendSample(file, static_cast<uint16_t>(400 + 300 * std::sin(i / 9.) * std::cos(i / 700.)));
    file.geotransform = tools::GeoTransform{-180, 360. / 128, 0, north, 0, degrees};
    const Outcome run = encode(file, " --explain");
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out.find("priorities") != std::string::npos;
  };
  EXPECT_TRUE(ordered(90, -180. / 64, "EPSG:4326"));
  EXPECT_TRUE(ordered(-90, 180. / 64, "EPSG:4326"));
  EXPECT_FALSE(ordered(5, -10. / 64, "EPSG:4326"));
  EXPECT_FALSE(ordered(90, -180. / 64, "EPSG:3857"));
  EXPECT_FALSE(ordered(90, -180. / 64, ""));
  EXPECT_FALSE(ordered(400, -180. / 64, "EPSG:4326"));
}

TEST_F(CliDomain, TexturesLieAsTheHeightsDoUnlessTheySayOtherwise) {
  tools::ImageFile image;
  image.width = 72;
  image.height = 6;
  image.channels = 1;
  image.data.resize(72 * 6);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::byte>(i * i);
  ASSERT_TRUE(tools::writeImage(path("t.png"), image).ok());
  const tools::HeightFile world = ground(36, -180, 10, "EPSG:4326");
  ASSERT_EQ(encode(world, " --texture t.png").code, 0);
  EXPECT_EQ(domainOf("texture"), "cylinder");
  image.place.geotransform = tools::GeoTransform{-180, 5, 0, 60, 0, -5};
  ASSERT_TRUE(tools::writeImage(path("round.tif"), image).ok());
  ASSERT_EQ(encode(world, " --texture round.tif").code, 0);
  EXPECT_EQ(domainOf("texture"), "cylinder");
  (*image.place.geotransform)[1] = 2.5;
  ASSERT_TRUE(tools::writeImage(path("half.tif"), image).ok());
  ASSERT_EQ(encode(world, " --texture half.tif").code, 0);
  EXPECT_EQ(domainOf("heights"), "cylinder");
  EXPECT_EQ(domainOf("texture"), "plane");
}

/// Whose first texel lies half a turn away.
TEST_F(CliDomain, WindowsGoOnAcross180Degrees) {
  tools::ImageFile image;
  image.width = 72;
  image.height = 6;
  image.channels = 1;
  image.data.resize(72 * 6);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::byte>(i * i);
  image.place.geotransform = tools::GeoTransform{0, 5, 0, 60, 0, -5};
  ASSERT_TRUE(tools::writeImage(path("round.tif"), image).ok());
  ASSERT_EQ(encode(ground(36, -180, 10, "EPSG:4326"), " --texture round.tif").code, 0);
  ASSERT_EQ(cli("decode s.tks --window 34 1 5 2 --height d.tif --texture e.tif").code, 0);
  const tools::HeightFile part = *tools::readHeights(path("d.tif"));
  EXPECT_EQ(*part.geotransform, (tools::GeoTransform{160, 10, 0, 50, 0, -10}));
  for (size_t i = 0; i < 5 * 2; ++i) {
    int16_t sample = 0;
    std::memcpy(&sample, part.data.data() + i * sizeof sample, sizeof sample);
    EXPECT_EQ(sample, ((1 + i / 5) * 36 + (34 + i % 5) % 36) % 17);
  }
  const tools::ImageFile texels = *tools::readImage(path("e.tif"));
  ASSERT_EQ(texels.width, 10u);
  EXPECT_EQ(*texels.place.geotransform, (tools::GeoTransform{160, 5, 0, 50, 0, -5}));
  for (size_t i = 0; i < 10 * 4; ++i)
    EXPECT_EQ(texels.data[i], image.data[(2 + i / 10) * 72 + 32 + i % 10]);
  EXPECT_EQ(cli("decode s.tks -f --height d.tif --window 34 1 37 1").code, 1);
  EXPECT_EQ(cli("decode s.tks -f --height d.tif --window 36 1 1 1").code, 1);
}

}  // namespace
}  // namespace tetrakis::test
