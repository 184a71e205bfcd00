// SPDX-License-Identifier: Apache-2.0
// Regions and windows through the command line.
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliWindows : public CliTest {};

/// Samples of a window. row: places of the whole in one; place: its bytes.
std::vector<std::byte> cropOf(const std::vector<std::byte>& all, size_t row, size_t place,
                              const tks_window& window) {
  std::vector<std::byte> out;
  for (size_t y = window.y; y < size_t{window.y} + window.height; ++y) {
    const auto from = all.begin() + static_cast<ptrdiff_t>((y * row + window.x) * place);
    out.insert(out.end(), from, from + static_cast<ptrdiff_t>(window.width * place));
  }
  return out;
}

TEST_F(CliWindows, WritesThePartOfHeightsAndTexture) {
  const tools::HeightFile heights = hills(65);
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  ASSERT_EQ(cli("synth --size 33 -o s").code, 0);
  ASSERT_EQ(
      cli("encode h.tif --texture s/texture.png --regions 16 --threads 2 --lossless -o w.tks").code,
      0);
  EXPECT_NE(cli("info w.tks --json").out.find("\"regions\": 16"), std::string::npos);
  ASSERT_EQ(cli("decode w.tks --height a.tif --texture a.png").code, 0);
  const Outcome run = cli("decode w.tks --window 40,3,10,20 --height b.tif --texture b.png");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto part = tools::readHeights(path("b.tif"));
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(part->width, 10u);
  EXPECT_EQ(part->height, 20u);
  EXPECT_TRUE(sameBytes(part->data, cropOf(heights.data, 65, 2, {40, 3, 10, 20})));
  const auto whole = tools::readImage(path("a.png")), image = tools::readImage(path("b.png"));
  ASSERT_TRUE(whole.ok() && image.ok());
  // Columns 40 to 49 of 0 to 64, rows 3 to 22, each as wide as it is.
  const auto edge = [](double sample, size_t texels) {
    return static_cast<size_t>(std::lround((sample - 0.5) * static_cast<double>(texels) / 64));
  };
  const size_t x = edge(40, whole->width), y = edge(3, whole->height);
  EXPECT_EQ(image->width, edge(50, whole->width) - x);
  EXPECT_EQ(image->height, edge(23, whole->height) - y);
  const tks_window texels = {static_cast<uint32_t>(x), static_cast<uint32_t>(y), image->width,
                             image->height};
  EXPECT_TRUE(sameBytes(image->data, cropOf(whole->data, whole->width, whole->channels, texels)));
}

/// Whatever the texels of a sample are, of a texture with a place and without.
TEST_F(CliWindows, TexelsOfWindowsAdjoin) {
  tools::HeightFile heights = hills(100);
  heights.crs = "EPSG:32632";
  heights.geotransform = tools::GeoTransform{500000, 30, 0, 5200000, 0, -30};
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  for (const uint32_t side : {200, 150, 100, 37}) {
    for (const bool placed : {true, false}) {
      SCOPED_TRACE(std::to_string(side) + (placed ? " placed" : ""));
      tools::ImageFile image{side, side, 1, TKS_U8, {}};
      for (uint32_t i = 0; i < side * side; ++i) image.data.push_back(std::byte(i % side));
      const double texel = 3000.0 / side;
      if (placed) {
        image.place.crs = heights.crs;
        image.place.geotransform = tools::GeoTransform{500000, texel, 0, 5200000, 0, -texel};
      }
      ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
      ASSERT_EQ(cli("-q encode h.tif --texture t.tif --lossless -f -o w.tks").code, 0);
      uint32_t columns = 0;
      double end = 500000;
      for (const char* window : {"0,30,50,40", "50,30,13,40", "63,30,37,40"}) {
        ASSERT_EQ(cli(std::string("decode w.tks -f --texture b.tif --window ") + window).code, 0);
        const auto part = *tools::readImage(path("b.tif"));
        EXPECT_EQ(std::to_integer<uint32_t>(part.data[0]), columns);
        columns += part.width;
        if (!placed) continue;
        const tools::GeoTransform place = *part.place.geotransform;
        EXPECT_DOUBLE_EQ(place[0], end);
        end = place[0] + part.width * place[1];
      }
      EXPECT_EQ(columns, side);
      ASSERT_EQ(cli("decode w.tks -f --texture all.tif --window 0,0,100,100").code, 0);
      EXPECT_TRUE(sameBytes(tools::readImage(path("all.tif"))->data, image.data));
    }
  }
}

/// Twice the ground of the heights in each direction, from the same corner, or another projection.
TEST_F(CliWindows, TexelsLieOverTheSamplesWhateverTheTextureCovers) {
  tools::HeightFile heights = hills(40);
  heights.crs = "EPSG:32632";
  heights.geotransform = tools::GeoTransform{500000, 30, 0, 5200000, 0, -30};
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  tools::ImageFile image{80, 80, 3, TKS_U8, {}};
  for (uint32_t i = 0; i < 80 * 80; ++i)
    for (const uint32_t part : {i % 80, i / 80, 0u}) image.data.push_back(std::byte(part));
  const auto encode = [&](const std::string& crs, const tools::GeoTransform& place) {
    image.place.crs = crs;
    image.place.geotransform = place;
    ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
    const Outcome run = cli("encode h.tif --texture t.tif --lossless -f -o w.tks");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("covers other ground"), std::string::npos) << run.err;
  };
  const auto window = [&](const std::string& text) {
    const Outcome run = cli("decode w.tks -f --texture b.png --window " + text);
    EXPECT_EQ(run.code, 0) << run.err;
    return *tools::readImage(path("b.png"));
  };
  encode("EPSG:32632", {500000, 30, 0, 5200000, 0, -30});
  const tools::ImageFile part = window("10,20,8,5");
  EXPECT_EQ(part.width, 8u);
  EXPECT_EQ(part.height, 5u);
  EXPECT_EQ(part.data[0], std::byte{10});
  EXPECT_EQ(part.data[1], std::byte{20});

  // The first sample lies at 500015, 5199985: 9.0002 degrees east, 46.9534 north.
  encode("EPSG:4326", {8.99, 0.0004, 0, 46.96, 0, -0.0004});
  const tools::ImageFile other = window("0,0,1,1");
  EXPECT_NEAR(std::to_integer<int>(other.data[0]), (9.0002 - 8.99) / 0.0004, 1);
  EXPECT_NEAR(std::to_integer<int>(other.data[1]), (46.96 - 46.9534) / 0.0004, 1);

  image.place.crs = "EPSG:32632";
  image.place.geotransform = tools::GeoTransform{900000, 30, 0, 5200000, 0, -30};
  ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
  const Outcome beside = cli("encode h.tif --texture t.tif --lossless -f -o w.tks");
  EXPECT_NE(beside.err.find("lies beside the ground"), std::string::npos) << beside.err;
  const Outcome none = cli("decode w.tks --window 1,1,2,2 --texture c.png");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("beside the ground of --window"), std::string::npos) << none.err;
  EXPECT_EQ(cli("decode w.tks --window 1,1,2,2 --height c.tif").code, 0);
}

/// Of the same ground, from another corner.
TEST_F(CliWindows, TurnedTexturesAreNotedAsTurned) {
  tools::HeightFile heights = hills(40);
  heights.crs = "EPSG:32632";
  heights.geotransform = tools::GeoTransform{500000, 30, 0, 5200000, 0, -30};
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  tools::ImageFile image = photo(80);
  image.place.crs = heights.crs;
  const auto noteOn = [&](const tools::GeoTransform& place) {
    image.place.geotransform = place;
    EXPECT_TRUE(tools::writeImage(path("t.tif"), image).ok());
    return cli("encode h.tif --texture t.tif --lossless -f -o w.tks").err;
  };
  for (const tools::GeoTransform& place :
       {tools::GeoTransform{500000, 15, 0, 5198800, 0, 15},     // south-up
        tools::GeoTransform{501200, -15, 0, 5198800, 0, 15},    // by half a circle
        tools::GeoTransform{500000, 0, 15, 5198800, 15, 0}}) {  // by a quarter
    const std::string note = noteOn(place);
    EXPECT_NE(note.find("begins at another corner"), note.npos) << note;
    EXPECT_EQ(note.find("other ground"), note.npos) << note;
  }
  EXPECT_EQ(noteOn({500000, 15, 0, 5200000, 0, -15}).find("ground"), std::string::npos);
  const std::string beyond = noteOn({500000, 15, 0, 5198500, 0, 15});
  EXPECT_NE(beyond.find("covers other ground"), beyond.npos) << beyond;
}

TEST_F(CliWindows, RefusesWhatMakesNoSense) {
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), hills(17)).ok());
  EXPECT_EQ(cli("encode h.tif --regions 100 --lossless -o w.tks").code, 1);
  EXPECT_EQ(cli("encode h.tif --regions many --lossless -o w.tks").code, 1);
  ASSERT_EQ(cli("encode h.tif --regions off --lossless -o w.tks").code, 0);
  for (const char* window : {"0,0,18,1", "17,0,1,1", "0,0,0,4", "1,2,3", "4294967295,0,2,1"}) {
    const Outcome run = cli(std::string("decode w.tks --height b.tif --window ") + window);
    EXPECT_EQ(run.code, 1) << window;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_EQ(cli("decode w.tks --mesh b.glb --window 0,0,4,4").code, 1);
}

}  // namespace
}  // namespace tetrakis::test
