// SPDX-License-Identifier: Apache-2.0
// CliTiles makes terrain tiles and reads them.
#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/cli_fixture.hpp"
#include "tests/support/terrain_tile_reader.hpp"

namespace tetrakis::test {

using nlohmann::json;

/// Level, column, row.
using TileName = std::array<uint32_t, 3>;

class CliTiles : public CliTest {
 protected:
  /// Floats over EPSG:4326: 1000 + 4000 (x - west) + 9000 (y - south) metres.
  static tools::HeightFile ramp(uint32_t width, uint32_t height, double west, double south) {
    constexpr double kStep = 0.001;
    tools::HeightFile file;
    file.width = width;
    file.height = height;
    file.sample = TKS_F32;
    file.unit = "m";
    file.crs = "EPSG:4326";
    file.geotransform = tools::GeoTransform{west, kStep, 0, south + height * kStep, 0, -kStep};
    for (uint32_t i = 0; i < width * height; ++i) {
      const double x = (i % width + 0.5) * kStep, y = (height - i / width - 0.5) * kStep;
      const auto sample = static_cast<float>(1000 + 4000 * x + 9000 * y);
      const auto bytes = std::as_bytes(std::span(&sample, 1));
      file.data.insert(file.data.end(), bytes.begin(), bytes.end());
    }
    return file;
  }

  /// Encodes it as s.tks.
  void encode(const tools::HeightFile& file) {
    ASSERT_TRUE(tools::writeHeights(path("h.tif"), file).ok());
    const Outcome run = cli("-q encode h.tif --max-error 0.001 -f -o s.tks");
    ASSERT_EQ(run.code, 0) << run.err;
  }

  std::map<TileName, TerrainTile> readTiles(const std::string& folder) {
    std::map<TileName, TerrainTile> tiles;
    const json layer = json::parse(content(folder + "/layer.json"));
    EXPECT_EQ(layer["format"], "quantized-mesh-1.0");
    for (uint32_t level = 0; level < layer["available"].size(); ++level) {
      const json range = layer["available"][level][0];
      for (uint32_t x = range["startX"]; x <= range["endX"]; ++x)
        for (uint32_t y = range["startY"]; y <= range["endY"]; ++y)
          tiles[{level, x, y}] =
              TerrainTileReader(content(folder + "/" + std::to_string(level) + "/" +
                                        std::to_string(x) + "/" + std::to_string(y) + ".terrain"))
                  .read();
    }
    EXPECT_EQ(layer["maxzoom"], layer["available"].size() - 1);
    return tiles;
  }

  /// Places and heights along one edge.
  static std::string edgeText(const TerrainTile& tile, size_t edge) {
    std::string text;
    for (const uint16_t i : tile.edges[edge])
      text += std::to_string(edge % 2 == 0 ? tile.v[i] : tile.u[i]) + ":" +
              std::to_string(tile.metres(i)) + " ";
    return text;
  }

  static void expectCovered(const TerrainTile& tile) {
    constexpr int64_t kSide = 32767;
    int64_t area = 0;
    for (size_t i = 0; i < tile.triangles.size(); i += 3) {
      const auto corner = [&](size_t k, const std::vector<uint32_t>& axis) {
        return int64_t{axis.at(tile.triangles[i + k])};
      };
      const int64_t twice =
          (corner(1, tile.u) - corner(0, tile.u)) * (corner(2, tile.v) - corner(0, tile.v)) -
          (corner(2, tile.u) - corner(0, tile.u)) * (corner(1, tile.v) - corner(0, tile.v));
      EXPECT_GT(twice, 0);
      area += twice;
    }
    EXPECT_EQ(area, 2 * kSide * kSide);
    EXPECT_EQ(tile.extensions.at(1).size(), 2 * tile.u.size());
  }

  void expectSound(const std::map<TileName, TerrainTile>& tiles) {
    for (const auto& item : tiles) {
      const TileName& name = item.first;
      const TerrainTile& tile = item.second;
      SCOPED_TRACE(std::to_string(name[0]) + "/" + std::to_string(name[1]) + "/" +
                   std::to_string(name[2]));
      expectCovered(tile);
      EXPECT_EQ(tile.extensions.contains(4), name[0] % 10 == 0);
      const auto east = tiles.find({name[0], name[1] + 1, name[2]});
      if (east != tiles.end()) {
        EXPECT_EQ(edgeText(tile, 2), edgeText(east->second, 0));
      }
      const auto north = tiles.find({name[0], name[1], name[2] + 1});
      if (north != tiles.end()) {
        EXPECT_EQ(edgeText(tile, 3), edgeText(north->second, 1));
      }
      if (name[0] > 0) {
        EXPECT_TRUE(tiles.contains({name[0] - 1, name[1] / 2, name[2] / 2}));
      }
    }
  }
};

}  // namespace tetrakis::test
