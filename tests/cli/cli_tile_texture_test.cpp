// SPDX-License-Identifier: Apache-2.0
// Textures of terrain tiles: each texel has the colour of its place on the globe, to the edges of
// the tile, in meshes as in tiles of imagery.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using nlohmann::json;

constexpr double kWest = 7.31, kSouth = 46.2, kPhotoStep = 0.001;
constexpr uint32_t kPhotoSide = 70;
constexpr double kMargin = 0.013;  ///< of the texture around the heights
constexpr uint32_t kPhotoTexels = 384;
constexpr double kTexel = (kPhotoSide * kPhotoStep + 2 * kMargin) / kPhotoTexels;

/// Red grows to the east, green to the north.
std::array<double, 2> colourAt(double longitude, double latitude) {
  return {(longitude - kWest + kMargin) / (kPhotoTexels * kTexel) * 240 + 8,
          (latitude - kSouth + kMargin) / (kPhotoTexels * kTexel) * 240 + 8};
}

using Point = std::array<double, 3>;

Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

class CliTileTexture : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    tools::HeightFile heights;
    heights.width = heights.height = kPhotoSide;
    heights.sample = TKS_U8;
    heights.data.resize(kPhotoSide * kPhotoSide);
    for (size_t i = 0; i < heights.data.size(); ++i)
      heights.data[i] = static_cast<std::byte>(i * i / 997 % 13);
    heights.crs = "EPSG:4326";
    heights.unit = "m";
    heights.geotransform =
        tools::GeoTransform{kWest, kPhotoStep, 0, kSouth + kPhotoSide * kPhotoStep, 0, -kPhotoStep};
    ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  }

  /// channels: 3, or 4 with an alpha that is 0 over the eastern half.
  void encode(uint32_t channels) {
    tools::ImageFile texture{kPhotoTexels, kPhotoTexels, channels, TKS_U8, {}};
    const double north = kSouth + kPhotoSide * kPhotoStep + kMargin;
    for (uint32_t i = 0; i < kPhotoTexels * kPhotoTexels; ++i) {
      const auto [red, green] = colourAt(kWest - kMargin + (i % kPhotoTexels + 0.5) * kTexel,
                                         north - (i / kPhotoTexels + 0.5) * kTexel);
      for (const double value :
           {red, green, 90.0, i % kPhotoTexels < kPhotoTexels / 2 ? 255.0 : 0.0})
        texture.data.push_back(static_cast<std::byte>(std::lround(value)));
      if (channels == 3) texture.data.pop_back();
    }
    texture.place.crs = "EPSG:4326";
    texture.place.geotransform = tools::GeoTransform{kWest - kMargin, kTexel, 0, north, 0, -kTexel};
    ASSERT_TRUE(tools::writeImage(path("t.tif"), texture).ok());
    const Outcome run = cli("-q encode h.tif --texture t.tif --lossless -f -o s.tks");
    ASSERT_EQ(run.code, 0) << run.err;
  }

  /// One GLB: its document and what its views hold.
  struct GlbFile {
    json document;
    std::string binary;

    explicit GlbFile(const std::string& bytes) {
      uint32_t length = 0;
      std::memcpy(&length, bytes.data() + 12, 4);
      document = json::parse(bytes.substr(20, length));
      binary = bytes.substr(28 + length);
    }
    std::string view(const json& number) const {
      const json& found = document["bufferViews"].at(number.get<size_t>());
      return binary.substr(found.value("byteOffset", 0), found["byteLength"]);
    }
    std::vector<float> attribute(const char* name) const {
      const json& numbers = document["meshes"][0]["primitives"][0]["attributes"];
      const std::string bytes =
          view(document["accessors"].at(numbers[name].get<size_t>())["bufferView"]);
      std::vector<float> values(bytes.size() / sizeof(float));
      std::memcpy(values.data(), bytes.data(), bytes.size());
      return values;
    }
    /// Of the vertices, in the axes of glTF.
    std::vector<Point> places() const {
      const std::vector<float> positions = attribute("POSITION");
      const json& origin = document["nodes"][0]["translation"];
      std::vector<Point> places(positions.size() / 3);
      for (size_t i = 0; i < positions.size(); ++i)
        places[i / 3][i % 3] = positions[i] + origin[i % 3].get<double>();
      return places;
    }
    /// Of 16 bits.
    std::vector<uint16_t> indices() const {
      const json& number = document["meshes"][0]["primitives"][0]["indices"];
      const std::string bytes = view(document["accessors"].at(number.get<size_t>())["bufferView"]);
      std::vector<uint16_t> values(bytes.size() / sizeof(uint16_t));
      std::memcpy(values.data(), bytes.data(), bytes.size());
      return values;
    }
  };

  tools::ImageFile pictureOf(const GlbFile& glb) {
    const json& image = glb.document["images"][0];
    const std::string name = image["mimeType"] == "image/png" ? "p.png" : "p.jpg";
    write(name, glb.view(image["bufferView"]));
    const auto read = tools::readImage(path(name));
    EXPECT_TRUE(read.ok());
    return read.ok() ? *read : tools::ImageFile{};
  }

  static double texel(const tools::ImageFile& picture, double u, double v, uint32_t channel) {
    const double x = u * picture.width - 0.5, y = v * picture.height - 0.5;
    const double left = std::min(std::floor(x), picture.width - 2.0);
    const double top = std::min(std::floor(y), picture.height - 2.0);
    const auto at = [&](double column, double row) {
      const size_t i = (size_t(row) * picture.width + size_t(column)) * picture.channels + channel;
      return std::to_integer<int>(picture.data.at(i)) * (1 - std::abs(x - column)) *
             (1 - std::abs(y - row));
    };
    return at(left, top) + at(left + 1, top) + at(left, top + 1) + at(left + 1, top + 1);
  }

  /// Its vertices have the colours of their places.
  static void expectPlaced(const GlbFile& glb, const tools::ImageFile& picture) {
    const std::vector<Point> places = glb.places();
    const std::vector<float> texcoords = glb.attribute("TEXCOORD_0");
    constexpr double kDegrees = 180 / std::numbers::pi, kFlat = 1 / 298.257223563;
    for (size_t i = 0; i < places.size(); ++i) {
      const Point& p = places[i];
      const double longitude = std::atan2(-p[2], p[0]) * kDegrees;
      const double latitude =
          std::atan2(p[1] / ((1 - kFlat) * (1 - kFlat)), std::hypot(p[0], p[2])) * kDegrees;
      const std::array<double, 2> colour = colourAt(longitude, latitude);
      for (uint32_t c = 0; c < 2; ++c)
        EXPECT_NEAR(texel(picture, texcoords[2 * i], texcoords[2 * i + 1], c), colour[c], 2.5);
    }
  }

  std::vector<std::string> filesBelow(const std::string& name, const std::string& extension) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(name)))
      if (entry.path().extension() == extension) files.push_back(entry.path().string());
    return files;
  }
};

TEST_F(CliTileTexture, MeshesHaveTheColoursOfTheirPlaces) {
  encode(3);
  ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles -o t").code, 0);
  const std::vector<std::string> files = filesBelow("t", ".glb");
  EXPECT_GT(files.size(), 3U);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const GlbFile glb(text(file));
    expectPlaced(glb, pictureOf(glb));
    EXPECT_EQ(glb.document["samplers"][0]["wrapS"], 33071);  // clamped
  }
}

TEST_F(CliTileTexture, SkirtsHangBelowTheEdgesOfTiles) {
  encode(3);
  ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles --no-skirts -o t").code, 0);
  ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles -o skirts").code, 0);
  size_t walls = 0;
  for (const std::string& file : filesBelow("t", ".glb")) {
    SCOPED_TRACE(file);
    const std::vector<Point> ground = GlbFile(text(file)).places();
    const GlbFile glb(text(path("skirts" + file.substr(path("t").size()))));
    const std::vector<Point> places = glb.places();
    ASSERT_TRUE(std::equal(ground.begin(), ground.end(), places.begin()));
    const std::vector<uint16_t> indices = glb.indices();
    for (size_t i = 0; i < indices.size(); i += 3) {
      const Point &a = places.at(indices[i]), &b = places.at(indices[i + 1]);
      const Point& c = places.at(indices[i + 2]);
      if (std::max({indices[i], indices[i + 1], indices[i + 2]}) < ground.size()) continue;
      ++walls;
      // It is seen from where this tile has no ground; parallels bend by some metres.
      const Point normal = cross(difference(b, a), difference(c, a));
      for (const Point& place : ground)
        EXPECT_LT(dot(normal, difference(place, a)), 10 * std::sqrt(dot(normal, normal)));
    }
    expectPlaced(glb, pictureOf(glb));
  }
  EXPECT_GT(walls, 50U);
  EXPECT_EQ(cli("tiles s.tks -o q --no-skirts").code, 1);
}

TEST_F(CliTileTexture, CutOutsKeepTheirAlpha) {
  encode(4);
  ASSERT_EQ(cli("-q tiles s.tks --format 3dtiles -o t").code, 0);
  size_t cut = 0;
  for (const std::string& file : filesBelow("t", ".glb")) {
    const GlbFile glb(text(file));
    const tools::ImageFile picture = pictureOf(glb);
    cut += picture.channels == 4;
    EXPECT_EQ(glb.document["materials"][0].contains("alphaMode"), picture.channels == 4);
  }
  EXPECT_GT(cut, 0U);
}

TEST_F(CliTileTexture, ImageryLiesOnItsGround) {
  encode(3);
  ASSERT_EQ(cli("-q tiles s.tks -o t").code, 0);
  const std::string map = content("t/imagery/tilemapresource.xml");
  EXPECT_NE(map.find("profile=\"global-geodetic\""), std::string::npos);
  size_t whole = 0;
  for (const std::string& file : filesBelow("t/imagery", ".webp")) {
    const auto picture = tools::readImage(file);
    if (!picture.ok()) continue;  // not opaque
    ++whole;
    const std::filesystem::path name(file), column = name.parent_path();
    const double side = 180 / std::exp2(std::stoi(column.parent_path().filename()));
    const double west = std::stoi(column.filename()) * side - 180;
    const double south = std::stoi(name.stem()) * side - 90;
    for (const auto& [x, y] : {std::pair(0, 0), {255, 0}, {100, 31}, {17, 255}}) {
      const std::array<double, 2> colour =
          colourAt(west + (x + 0.5) / 256 * side, south + (255.5 - y) / 256 * side);
      for (size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(std::to_integer<int>(
                        picture->data[(size_t(y) * 256 + size_t(x)) * picture->channels + c]),
                    colour[c], 5)
            << file << ' ' << x << ' ' << y;
    }
  }
  EXPECT_GT(whole, 0U);
}

TEST_F(CliTileTexture, OneWithoutAPlaceLiesOnTheSamples) {
  ASSERT_TRUE(tools::writeImage(path("p.png"), {2, 3, 1, TKS_U8, std::vector<std::byte>(6)}).ok());
  ASSERT_EQ(cli("-q encode h.tif --texture p.png --lossless -o s.tks").code, 0);
  for (const char* format : {"3dtiles", "quantized-mesh"}) {
    const Outcome run = cli(std::string("tiles s.tks -f -o t --format ") + format);
    EXPECT_EQ(run.code, 0) << run.err;
  }
}

}  // namespace
}  // namespace tetrakis::test
