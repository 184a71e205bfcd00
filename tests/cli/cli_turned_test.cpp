// SPDX-License-Identifier: Apache-2.0
// Rasters that do not begin in the north-west: south-up, turned, transposed, sheared, in degrees.
// Meshes, normals, textures and cameras are those of the ground, whatever way its rows run.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/tools/files/place/earth.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

struct Layout {
  const char* name;
  std::array<double, 4> steps;  ///< [1], [2], [4] and [5] of the geotransform
  const char* crs = "EPSG:32632";
};

constexpr double kDegree = 1e-4;
const std::vector<Layout> kLayouts{
    {"north up", {10, 0, 0, -20}},
    {"south up", {10, 0, 0, 20}},
    {"from the east", {-10, 0, 0, -20}},
    {"upside down", {-10, 0, 0, 20}},
    {"transposed", {0, 10, 20, 0}},
    {"a quarter turn", {0, 10, -20, 0}},
    {"turned", {10 * 0.8, 20 * 0.6, 10 * 0.6, -20 * 0.8}},
    {"turned and mirrored", {10 * 0.8, -20 * 0.6, 10 * 0.6, 20 * 0.8}},
    {"sheared", {10, 7, 1, -20}},
    {"south up in degrees", {kDegree, 0, 0, kDegree}, "EPSG:4326"},
    {"turned in degrees", {kDegree, kDegree / 2, kDegree / 3, -kDegree}, "EPSG:4326"},
};

class CliTurned : public CliTest {
 protected:
  static constexpr uint32_t kWidth = 17, kHeight = 14;

  /// Of a layout: its raster, which has its middle where all have theirs.
  class Ground {
   public:
    Ground(const Layout& layout, uint32_t width, uint32_t height) : width_(width), height_(height) {
      const auto& [a, b, c, d] = layout.steps;
      const bool degrees = layout.crs == std::string("EPSG:4326");
      const double x = degrees ? 9 : 500000, y = degrees ? 46 : 5200000;
      if (degrees) metres_ = tools::metresPerDegree(y);
      transform = {x - width / 2.0 * a - height / 2.0 * b, a, b,
                   y - width / 2.0 * c - height / 2.0 * d, c, d};
    }

    tools::GeoTransform transform;

    /// Metres east and south of the middle.
    std::array<double, 2> at(double column, double row) const {
      const double c = column - (width_ - 1) / 2.0, r = row - (height_ - 1) / 2.0;
      return {(c * transform[1] + r * transform[2]) * metres_.east,
              -(c * transform[4] + r * transform[5]) * metres_.north};
    }

   private:
    tools::MetresPerDegree metres_{1, 1};
    uint32_t width_, height_;
  };

  /// Unit vectors, east and south, along rows of texels and up their columns.
  struct TangentAxes {
    std::array<double, 2> right, up;

    explicit TangentAxes(const Ground& ground) {
      const std::array<double, 2> origin = ground.at(0, 0), next = ground.at(1, 0);
      const std::array<double, 2> below = ground.at(0, 1);
      right = {next[0] - origin[0], next[1] - origin[1]};
      const double length = std::hypot(right[0], right[1]);
      for (double& part : right) part /= length;
      up = {right[1], -right[0]};
      if (up[0] * (below[0] - origin[0]) + up[1] * (below[1] - origin[1]) > 0)
        up = {-up[0], -up[1]};
    }
  };

  /// A quadratic: central differences have its exact slopes.
  static double heightAt(double east, double south) {
    return 500 + 0.3 * east - 0.2 * south + 0.001 * east * east - 0.002 * east * south;
  }
  static std::array<double, 3> normalAt(double east, double south) {
    const double x = 0.3 + 0.002 * east - 0.002 * south, z = -0.2 - 0.002 * east;
    const double length = std::hypot(x, 1, z);
    return {-x / length, 1 / length, -z / length};
  }

  static double rough(double east, double south) {
    return 100 * std::sin(east * 0.9 + std::cos(south * 1.7)) * std::cos(south * 0.8 + east);
  }

  template <class Function>
  void writeHeights(const Layout& layout, const Ground& ground, uint32_t width, uint32_t height,
                    const Function& function) {
    tools::HeightFile file;
    file.width = width;
    file.height = height;
    file.sample = TKS_F32;
    file.unit = "m";
    file.crs = layout.crs;
    file.geotransform = ground.transform;
    for (uint32_t i = 0; i < width * height; ++i) {
      const auto [east, south] = ground.at(i % width, i / width);
      const auto sample = static_cast<float>(function(east, south));
      const auto bytes = std::as_bytes(std::span(&sample, 1));
      file.data.insert(file.data.end(), bytes.begin(), bytes.end());
    }
    ASSERT_TRUE(tools::writeHeights(path("h.tif"), file).ok());
  }

  /// s.tks: ground of heightAt() that lies so.
  Ground encodedGround(const Layout& layout) {
    const Ground ground(layout, kWidth, kHeight);
    writeHeights(layout, ground, kWidth, kHeight, heightAt);
    EXPECT_EQ(cli("-q encode h.tif --lossless -f -o s.tks").code, 0);
    return ground;
  }

  /// Wavefront OBJ, counting from 0.
  struct ObjMesh {
    std::vector<std::array<double, 3>> positions, normals;
    std::vector<std::array<double, 2>> texcoords;
    std::vector<std::array<size_t, 3>> triangles;
  };
  ObjMesh readObj(const std::string& name) {
    ObjMesh mesh;
    std::istringstream lines(content(name));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      std::array<double, 3> v{};
      if (key == "f") {
        auto& triangle = mesh.triangles.emplace_back();
        for (size_t& corner : triangle) {
          std::string word;
          words >> word;
          corner = std::stoul(word) - 1;
        }
        continue;
      }
      words >> v[0] >> v[1] >> v[2];
      if (key == "v") mesh.positions.push_back(v);
      if (key == "vn") mesh.normals.push_back(v);
      if (key == "vt") mesh.texcoords.push_back({v[0], 1 - v[1]});
    }
    return mesh;
  }

  static void expectFacingUp(const ObjMesh& mesh) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto& p = mesh.positions;
      const double up =
          (p[b][2] - p[a][2]) * (p[c][0] - p[a][0]) - (p[b][0] - p[a][0]) * (p[c][2] - p[a][2]);
      EXPECT_GT(up, 0);
    }
  }

  /// A camera straight above a place, which sees so many metres to each side.
  void writeCamera(double east, double south, double sees) {
    const double above = 3000;
    const nlohmann::json camera{{"name", "above"},
                                {"eye", {east, above, south}},
                                {"target", {east, 0, south}},
                                {"up", {0, 0, -1}},
                                {"fov_y", 2 * std::atan(sees / above) * 180 / std::numbers::pi},
                                {"width", 256},
                                {"height", 256}};
    write("c.json", nlohmann::json{{"cameras", {camera}}}.dump());
  }
};

TEST_F(CliTurned, MeshesLieAsTheGroundDoes) {
  for (const Layout& layout : kLayouts) {
    SCOPED_TRACE(layout.name);
    const Ground ground = encodedGround(layout);
    ASSERT_EQ(cli("-q decode s.tks -f --mesh m.obj").code, 0);
    const ObjMesh mesh = readObj("m.obj");
    ASSERT_EQ(mesh.positions.size(), size_t{kWidth} * kHeight);
    expectFacingUp(mesh);
    std::set<std::pair<long, long>> wanted, got;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const auto [east, south] = ground.at(i % kWidth, i / kWidth);
      wanted.emplace(std::lround(east * 8), std::lround(south * 8));
    }
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& [east, up, south] = mesh.positions[i];
      got.emplace(std::lround(east * 8), std::lround(south * 8));
      EXPECT_NEAR(up, heightAt(east, south), 1e-2);
    }
    EXPECT_EQ(got.size(), wanted.size());
    size_t alike = 0;
    for (const auto& [x, z] : got)
      for (const long beside : {-1, 0, 1})
        alike += wanted.contains({x + beside, z}) || wanted.contains({x, z + beside}) ? 1 : 0;
    EXPECT_GE(alike, wanted.size());
  }
}

TEST_F(CliTurned, NormalsOfMeshesAreThoseOfTheGround) {
  for (const Layout& layout : kLayouts) {
    SCOPED_TRACE(layout.name);
    const Ground ground = encodedGround(layout);
    ASSERT_EQ(cli("-q decode s.tks -f --mesh m.obj").code, 0);
    const ObjMesh mesh = readObj("m.obj");
    size_t inner = 0;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const uint32_t column = i % kWidth, row = i / kWidth;
      if (column % (kWidth - 1) == 0 || row % (kHeight - 1) == 0) continue;
      const auto [east, south] = ground.at(column, row);
      for (size_t v = 0; v < mesh.positions.size(); ++v) {
        if (std::hypot(mesh.positions[v][0] - east, mesh.positions[v][2] - south) > 0.1) continue;
        ++inner;
        for (size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(mesh.normals[v][k], normalAt(east, south)[k], 2e-3);
      }
    }
    EXPECT_EQ(inner, size_t{kWidth - 2} * (kHeight - 2));
  }
}

TEST_F(CliTurned, NormalMapsAreInTheTangentSpaceOfTheTexture) {
  for (const Layout& layout : kLayouts) {
    SCOPED_TRACE(layout.name);
    const Ground ground = encodedGround(layout);
    ASSERT_EQ(cli("-q decode s.tks -f --normal-map n.png").code, 0);
    const auto map = tools::readImage(path("n.png"));
    ASSERT_TRUE(map.ok());
    const auto [right, up] = TangentAxes(ground);
    for (uint32_t row = 1; row + 1 < kHeight; ++row)
      for (uint32_t column = 1; column + 1 < kWidth; ++column) {
        const std::byte* const texel = &map->data[(size_t{row} * kWidth + column) * 3];
        const auto part = [texel](size_t k) { return std::to_integer<int>(texel[k]) / 127.5 - 1; };
        const auto [east, south] = ground.at(column, row);
        const std::array<double, 3> wanted = normalAt(east, south);
        EXPECT_NEAR(part(0) * right[0] + part(1) * up[0], wanted[0], 0.012);
        EXPECT_NEAR(part(2), wanted[1], 0.012);
        EXPECT_NEAR(part(0) * right[1] + part(1) * up[1], wanted[2], 0.012);
      }
  }
}

TEST_F(CliTurned, TexturesLieOnTheirGround) {
  constexpr uint32_t kTexels = 64;
  for (const Layout& layout : kLayouts) {
    const Ground ground(layout, kWidth, kHeight);
    writeHeights(layout, ground, kWidth, kHeight, heightAt);
    const bool degrees = layout.crs == std::string("EPSG:4326");
    const double size = degrees ? 0.004 : 600, texel = size / kTexels;
    for (const double step : {-texel, texel}) {
      SCOPED_TRACE(std::string(layout.name) + (step < 0 ? ", texture north up" : ", south up"));
      tools::ImageFile image{kTexels, kTexels, 3, TKS_U8, {}};
      image.data.resize(size_t{3} * kTexels * kTexels, std::byte{90});
      image.place.crs = layout.crs;
      const double west = (degrees ? 9 : 500000) - size / 2;
      const double first = (degrees ? 46 : 5200000) - (step < 0 ? -1 : 1) * size / 2;
      image.place.geotransform = tools::GeoTransform{west, texel, 0, first, 0, step};
      ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
      ASSERT_EQ(cli("-q encode h.tif --texture t.tif --lossless -f -o s.tks").code, 0);
      ASSERT_EQ(cli("-q decode s.tks -f --mesh m.obj").code, 0);
      const ObjMesh mesh = readObj("m.obj");
      const double metres = degrees ? tools::metresPerDegree(46).east : 1;
      const double high = degrees ? tools::metresPerDegree(46).north : 1;
      for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto& [east, up, south] = mesh.positions[i];
        const double down = (step < 0 ? south : -south) / high;
        EXPECT_NEAR(mesh.texcoords[i][0], east / metres / size + 0.5, 1e-4);
        EXPECT_NEAR(mesh.texcoords[i][1], down / size + 0.5, 1e-4);
      }
    }
  }
}

TEST_F(CliTurned, CamerasSeeTheGroundThatTheyLookAt) {
  constexpr uint32_t kSide = 65;
  constexpr double kSees = 80;
  for (const Layout& layout : kLayouts) {
    SCOPED_TRACE(layout.name);
    const Ground ground(layout, kSide, kSide);
    writeHeights(layout, ground, kSide, kSide, rough);
    // Off the axes of all layouts.
    const auto [east, south] = ground.at(50, 12);
    writeCamera(east, south, kSees);
    ASSERT_EQ(cli("-q encode h.tif --lossless -f -o s.tks").code, 0);
    ASSERT_EQ(cli("-q decode s.tks -f --cameras c.json --mesh m.obj").code, 0);
    const ObjMesh mesh = readObj("m.obj");
    expectFacingUp(mesh);
    EXPECT_LT(mesh.triangles.size(), size_t{kSide} * kSide / 2);
    std::array<double, 3> sum{};
    for (const auto& triangle : mesh.triangles)
      for (size_t k = 0; k < 3; ++k) sum[k] += mesh.positions[triangle[0]][k];
    const auto count = static_cast<double>(mesh.triangles.size());
    EXPECT_NEAR(sum[0] / count, east, kSees / 2);
    EXPECT_NEAR(sum[2] / count, south, kSees / 2);
  }
}

/// Heights alone have nothing to share with: the texture tells.
TEST_F(CliTurned, EncodersServeTheGroundThatCamerasLookAt) {
  constexpr uint32_t kSide = 257, kTexels = 256;
  const tools::ImageFile picture = photo(kTexels);
  ASSERT_TRUE(tools::writeImage(path("t.png"), picture).ok());
  for (const size_t i : {0U, 1U, 4U, 7U}) {
    const Layout& layout = kLayouts[i];
    SCOPED_TRACE(layout.name);
    const Ground ground(layout, kSide, kSide);
    writeHeights(layout, ground, kSide, kSide, heightAt);
    const auto [east, south] = ground.at(192, 64);
    writeCamera(east, south, 400);
    ASSERT_EQ(cli("-q encode h.tif --texture t.png --bytes 16k --cameras c.json -f -o s.tks").code,
              0);
    ASSERT_EQ(cli("-q decode s.tks -f --texture d.png").code, 0);
    const auto decoded = tools::readImage(path("d.png"));
    ASSERT_TRUE(decoded.ok());
    const auto errorAround = [&](uint32_t column, uint32_t row) {
      double squares = 0;
      for (uint32_t y = row - 12; y < row + 12; ++y)
        for (uint32_t x = 3 * (column - 12); x < 3 * (column + 12); ++x) {
          const size_t at = size_t{3} * kTexels * y + x;
          const int off =
              std::to_integer<int>(decoded->data[at]) - std::to_integer<int>(picture.data[at]);
          squares += off * off;
        }
      return squares;
    };
    for (const auto& [column, row] : {std::pair(64U, 64U), {192U, 192U}, {64U, 192U}})
      EXPECT_LT(2 * errorAround(192, 64), errorAround(column, row));
  }
}

}  // namespace
}  // namespace tetrakis::test
