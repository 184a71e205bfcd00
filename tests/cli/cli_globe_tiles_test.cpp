// SPDX-License-Identifier: Apache-2.0
// Terrain tiles of the whole Earth: they meet at 180 degrees and at the poles as anywhere else.
#include <algorithm>
#include <set>

#include "conformance/samples/terrain_samples.hpp"
#include "tests/cli/cli_tiles_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliGlobeTiles : public CliTiles {
 protected:
  /// Rough ground above 100 m, whose columns begin at a longitude and whose rows go from pole to
  /// pole, as areas or with samples on the poles.
  static tools::HeightFile earth(double west, bool points) {
    constexpr uint32_t kWidth = 180, kAreas = 90;
    tools::HeightFile file;
    file.width = kWidth;
    file.height = points ? kAreas + 1 : kAreas;
    file.sample = TKS_I16;
    file.unit = "m";
    file.crs = "EPSG:4326";
    file.geotransform = tools::GeoTransform{west, 2, 0, points ? 91. : 90., 0, -2};
    for (uint32_t i = 0; i < kWidth * file.height; ++i) {
      const auto sample =
          static_cast<int16_t>(100 + samples::ridges(i % kWidth, i / kWidth, 5) / 8);
      const auto bytes = std::as_bytes(std::span(&sample, 1));
      file.data.insert(file.data.end(), bytes.begin(), bytes.end());
    }
    return file;
  }

  std::map<TileName, TerrainTile> tilesOf(const tools::HeightFile& file,
                                          const std::string& domain) {
    EXPECT_TRUE(tools::writeHeights(path("h.tif"), file).ok());
    const Outcome made = cli("-q encode h.tif --bytes 5k --domain " + domain + " -f -o s.tks");
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome run = cli("-q tiles s.tks -f -o t");
    EXPECT_EQ(run.code, 0) << run.err;
    return readTiles("t");
  }

  /// Of the vertices of a western or eastern edge between its corners. At a pole, straight down has
  /// four codes.
  static std::string normalsText(const TerrainTile& tile, size_t edge) {
    std::string text;
    for (const uint16_t i : tile.edges[edge])
      if (tile.v[i] > 0 && tile.v[i] < 32767) text += tile.extensions.at(1).substr(2 * i, 2);
    return text;
  }

  static void expectClosed(const std::map<TileName, TerrainTile>& tiles) {
    for (const auto& item : tiles) {
      const auto& [level, x, y] = item.first;
      const TerrainTile& tile = item.second;
      SCOPED_TRACE(std::to_string(level) + "/" + std::to_string(x) + "/" + std::to_string(y));
      for (size_t i = 0; i < tile.u.size(); ++i) EXPECT_GT(tile.metres(i), 0);
      if (x == 0) {
        const auto last = tiles.find({level, (2u << level) - 1, y});
        ASSERT_NE(last, tiles.end());
        EXPECT_EQ(edgeText(tile, 0), edgeText(last->second, 2));
        EXPECT_EQ(normalsText(tile, 0), normalsText(last->second, 2));
      }
    }
  }

  /// A pole is one point, whatever the tile and the longitude.
  static void expectPoles(const std::map<TileName, TerrainTile>& tiles) {
    std::map<std::pair<uint32_t, bool>, std::set<double>> heights;
    for (const auto& item : tiles) {
      const auto& [level, x, y] = item.first;
      for (const bool north : {false, true}) {
        if (y != (north ? (1u << level) - 1 : 0)) continue;
        for (const uint16_t i : item.second.edges[north ? 3 : 1])
          heights[{level, north}].insert(item.second.metres(i));
      }
    }
    EXPECT_GE(heights.size(), 4U);
    for (const auto& pole : heights) EXPECT_EQ(pole.second.size(), 1U) << pole.first.first;
  }
};

TEST_F(CliGlobeTiles, MeetAtTheAntimeridianAndAtThePoles) {
  // The last one has samples at 180 degrees.
  for (const auto& [west, points] :
       {std::pair(-180., false), {0., true}, {-100., false}, {-181., true}}) {
    for (const char* const domain : {"cylinder", "cube", "plane"}) {
      SCOPED_TRACE(std::to_string(west) + " " + domain);
      const auto tiles = tilesOf(earth(west, points), domain);
      expectSound(tiles);
      expectClosed(tiles);
      expectPoles(tiles);
    }
  }
}

/// Of a picture whose columns begin at longitude 0, too.
TEST_F(CliGlobeTiles, HaveTheTextureAllRound) {
  constexpr uint32_t kWidth = 512, kHeight = 256;
  constexpr double kTexel = 360. / kWidth;
  const auto redAt = [](double longitude) {
    return 128 + 100 * std::cos(longitude * std::acos(-1) / 180);
  };
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), earth(-180, false)).ok());
  for (const double west : {0., -180.}) {
    tools::ImageFile texture{kWidth, kHeight, 3, TKS_U8, {}};
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const double red = redAt(west + (i % kWidth + 0.5) * kTexel);
      for (const double value : {red, 90., 40.})
        texture.data.push_back(static_cast<std::byte>(std::lround(value)));
    }
    texture.place.crs = "EPSG:4326";
    texture.place.geotransform = tools::GeoTransform{west, kTexel, 0, 90, 0, -kTexel};
    ASSERT_TRUE(tools::writeImage(path("t.tif"), texture).ok());
    ASSERT_EQ(cli("-q encode h.tif --texture t.tif --psnr 45 -f -o s.tks").code, 0);
    const Outcome run = cli("-q tiles s.tks -f -o t");
    ASSERT_EQ(run.code, 0) << run.err;
    for (uint32_t x = 0; x < 4; ++x) {
      const auto picture = tools::readImage(path("t/imagery/1/" + std::to_string(x) + "/0.webp"));
      ASSERT_TRUE(picture.ok()) << x;
      for (const uint32_t column : {0u, 100u, 255u}) {
        const std::byte red = picture->data[(100 * 256 + column) * size_t{picture->channels}];
        EXPECT_NEAR(std::to_integer<int>(red), redAt(90.0 * x - 180 + (column + 0.5) / 256 * 90), 6)
            << west << ' ' << x << ' ' << column;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
