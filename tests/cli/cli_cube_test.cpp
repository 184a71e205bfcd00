// SPDX-License-Identifier: Apache-2.0
// Rasters that the command line puts on a cube, what comes back, and globes of cubes and cylinders.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/cli/cli_globe_fixture.hpp"
#include "tests/support/welded_mesh.hpp"

namespace tetrakis::test {
namespace {

TEST_F(CliCube, GivesTheGridBack) {
  const Outcome run = encodeCube(" --psnr 60");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("cube of depth 5"), std::string::npos) << run.err;
  const Json heights = Json::parse(cli("info --json s.tks").out)["heights"];
  EXPECT_EQ(heights["domain"], "forest");
  EXPECT_EQ(heights["forest"]["depth"], 5);
  EXPECT_EQ(heights["forest"]["cube"], true);
  EXPECT_EQ(heights["forest"]["grid_width"], 72);
  const tools::HeightFile back = decoded();
  ASSERT_EQ(back.width, 72u);
  ASSERT_EQ(back.height, 36u);
  EXPECT_EQ(back.geotransform, world_.geotransform);
  EXPECT_EQ(back.crs, world_.crs);
  for (size_t i = 0; i < 72 * 36; ++i) ASSERT_NEAR(sampleOf(back, i), sampleOf(world_, i), 12);
}

TEST_F(CliCube, GivesWindowsOfTheGrid) {
  ASSERT_EQ(encodeCube(" --bytes 3000 --depth 4").code, 0);
  const tools::HeightFile whole = decoded(), part = decoded(" --window 60 30 12 6");
  ASSERT_EQ(part.width, 12u);
  EXPECT_EQ(*part.geotransform, (tools::GeoTransform{120, 5, 0, -60, 0, -5}));
  for (size_t i = 0; i < 12 * 6; ++i)
    EXPECT_EQ(sampleOf(part, i), sampleOf(whole, (30 + i / 12) * 72 + 60 + i % 12));
  const tools::HeightFile across = decoded(" --window 60 30 20 6");
  EXPECT_EQ(*across.geotransform, *part.geotransform);
  for (size_t i = 0; i < 20 * 6; ++i)
    EXPECT_EQ(sampleOf(across, i), sampleOf(whole, (30 + i / 20) * 72 + (60 + i % 20) % 72));
  EXPECT_EQ(cli("decode s.tks -f --height d.tif --window 60 30 73 6").code, 1);
  for (const char* other : {"--mesh m.glb", "--normal-map n.png", "--height d.r16 --size unity"})
    EXPECT_EQ(cli(std::string("decode s.tks -f ") + other).code, 1) << other;
}

/// What a cube was made of is said of the first heights alone.
TEST_F(CliCube, ComesBeforeOtherHeights) {
  ASSERT_EQ(encodeCube(" --bytes 3000 --depth 4").code, 0);
  ASSERT_EQ(cli("combine s.tks again=s.tks -o two.tks").code, 1);
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --lossless -o plane.tks").code, 0);
  EXPECT_EQ(cli("combine plane.tks cube=s.tks -o two.tks").code, 1);
  ASSERT_EQ(cli("combine s.tks plane=plane.tks -o two.tks").code, 0);
  ASSERT_EQ(cli("decode two.tks -f --height again.tif").code, 0);
  EXPECT_TRUE(sameBytes(tools::readHeights(path("again.tif"))->data, decoded().data));
}

TEST_F(CliCube, LevelsAreCoarserGridsOfTheSameGround) {
  ASSERT_EQ(encodeCube(" --psnr 70").code, 0);
  const tools::HeightFile half = decoded(" --level 1");
  ASSERT_EQ(half.width, 36u);
  ASSERT_EQ(half.height, 18u);
  EXPECT_EQ(*half.geotransform, (tools::GeoTransform{-180, 10, 0, 90, 0, -10}));
  for (int i = 0; i < 36 * 18; ++i) {
    const double south = (i / 36 + 0.5) * 2 * 0.0872664626;
    const double east = (i % 36 + 0.25) * 2 * 0.0872664626;
    EXPECT_NEAR(sampleOf(half, static_cast<size_t>(i)),
                1000 * std::sin(south) * std::cos(east) + 2000, 25);
  }
  const tools::HeightFile eighth = decoded(" --level 3");
  EXPECT_EQ(eighth.width, 9u);
  EXPECT_EQ(eighth.height, 5u);
  EXPECT_NEAR((*eighth.geotransform)[5], -36, 1e-9);
  EXPECT_EQ(cli("decode s.tks -f --height d.tif --level 9").code, 1);
}

/// What is decoded for a window makes the samples that the whole has there: at the poles, across
/// 180 degrees, on the sides of faces.
TEST_F(CliCube, WindowsOfRegionsAreThoseOfTheWhole) {
  for (const char* regions : {" --regions 16", " --regions off"}) {
    ASSERT_EQ(encodeCube(std::string(" --psnr 70 --depth 6 --index") + regions).code, 0);
    const tools::HeightFile whole = decoded();
    for (const char* window : {"0,0,72,3", "60,10,30,9", "8,4,3,28", "35,33,1,3"}) {
      const tools::HeightFile part = decoded(std::string(" --window ") + window);
      uint32_t x = 0, y = 0;
      ASSERT_EQ(std::sscanf(window, "%u,%u", &x, &y), 2);
      for (uint32_t i = 0; i < part.width * part.height; ++i) {
        const size_t at = (y + i / part.width) * size_t{72} + (x + i % part.width) % 72;
        ASSERT_EQ(sampleOf(part, i), sampleOf(whole, at)) << window;
      }
    }
  }
}

TEST_F(CliCube, RefusesWhatKnowsPlanesAlone) {
  for (const char* options :
       {"--bytes 2k --triangles 500", "--bytes 2k --view low", "--bytes 2k --cameras c.json",
        "--bytes 2k --engine rendered", "--bytes 2k --report r", "--lossless", "--max-error 5"}) {
    const Outcome run = encodeCube(std::string(" ") + options);
    EXPECT_EQ(run.code, 1) << options;
    EXPECT_NE(run.err.find("does not go with --domain cube"), std::string::npos) << run.err;
  }
}

/// `compare` judges the grid that `decode` writes.
TEST_F(CliCube, IsComparedOnItsGrid) {
  ASSERT_EQ(encodeCube(" --bytes 2000").code, 0);
  const tools::HeightFile back = decoded();
  double squares = 0;
  for (size_t i = 0; i < 72 * 36; ++i)
    squares += std::pow(sampleOf(back, i) - sampleOf(world_, i), 2);
  const Outcome run = cli("compare s.tks --height g.tif --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(Json::parse(run.out)["height_rmse"], std::sqrt(squares / (72 * 36)), 1e-9);
  EXPECT_EQ(cli("compare s.tks --height g.tif --triangles 500").code, 1);
  ASSERT_TRUE(tools::writeHeights(path("other.tif"), ground(36, -180, 10, "EPSG:4326")).ok());
  EXPECT_EQ(cli("compare s.tks --height other.tif").code, 7);
  const Outcome plan = cli("plan s.tks --channel 8k/s --seconds 1");
  EXPECT_EQ(plan.code, 0) << plan.err;
}

class CliGlobe : public CliCube {
 protected:
  /// Of an .obj file.
  checks::WeldedMesh meshOf(const std::string& options) {
    const Outcome run = cli("decode s.tks -f --mesh m.obj --globe" + options);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    points_.clear();
    std::vector<uint32_t> triangles;
    std::ifstream file(path("m.obj"));
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string kind, corner;
      words >> kind;
      if (kind == "v") {
        auto& [x, y, z] = points_.emplace_back();
        words >> x >> y >> z;
      }
      while (kind == "f" && words >> corner)
        triangles.push_back(static_cast<uint32_t>(std::stoul(corner)) - 1);
    }
    return checks::weldedMesh(points_, triangles);
  }
  double farthest() const {
    double most = 0;
    for (const auto& [x, y, z] : points_) most = std::max(most, std::hypot(x, y, z));
    return most;
  }

  std::vector<std::array<double, 3>> points_;
};

TEST_F(CliGlobe, IsClosedWhetherItIsACylinderOrACube) {
  for (const char* domain : {"cylinder", "cube", "plane"}) {
    SCOPED_TRACE(domain);
    ASSERT_EQ(encodeCube(std::string(" --bytes 4000 --domain ") + domain).code, 0);
    for (const char* options : {"", " --triangles 500", " --coded-mesh", " --bytes 700"}) {
      const checks::WeldedMesh mesh = meshOf(options);
      EXPECT_EQ(mesh.open, 0u) << options;
      EXPECT_EQ(mesh.euler(), 2) << options;
      EXPECT_NEAR(farthest(), 6381000, 5000) << options;
    }
  }
}

TEST_F(CliGlobe, LiesOnTheBodyOfItsReferenceSystem) {
  world_.crs = "ESRI:104903";  // the Moon, a sphere
  ASSERT_EQ(encodeCube(" --bytes 4000 --domain cylinder").code, 0);
  meshOf("");
  const double once = farthest() - 1737400;
  EXPECT_NEAR(once, 3000, 100);
  meshOf(" --exaggeration 50");
  EXPECT_NEAR(farthest() - 1737400, 50 * once, 10);
}

/// Of textures in regions over a cylinder and over a cube, what a camera sees comes first.
TEST_F(CliGlobe, ReordersForCamerasOfAGlobe) {
  tools::ImageFile image;
  image.width = 256;
  image.height = 128;
  image.channels = 1;
  for (uint32_t i = 0; i < 256 * 128; ++i)
    image.data.push_back(static_cast<std::byte>((i * 2654435761u) >> 24));
  image.place.geotransform = tools::GeoTransform{-180, 360. / 256, 0, 90, 0, -180. / 128};
  ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
  std::ofstream(path("c.json")) << R"({"cameras": [{"eye": [0, 0, -2e7], "target": [0, 0, 0],
    "fov_y": 40, "width": 1000, "height": 800}]})";  // above 90 degrees east
  const auto squares = [&](const char* stream, uint32_t first) {
    EXPECT_EQ(cli(std::string("decode -f --bytes 10k --texture d.tif ") + stream).code, 0);
    const tools::ImageFile back = *tools::readImage(path("d.tif"));
    double sum = 0;
    for (uint32_t i = 0; i < 64 * 64; ++i) {
      const size_t at = (32 + i / 64) * 256 + first + i % 64;
      sum +=
          std::pow(std::to_integer<int>(back.data[at]) - std::to_integer<int>(image.data[at]), 2);
    }
    return sum;
  };
  for (const char* domain : {"cylinder", "cube"}) {
    SCOPED_TRACE(domain);
    ASSERT_EQ(
        encodeCube(std::string(" --bytes 30k --texture t.tif --regions 32 --index --domain ") +
                   domain)
            .code,
        0);
    const Outcome run = cli("reorder s.tks -f -o r.tks --globe --cameras c.json");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(cli("verify r.tks").code, 0);
    EXPECT_LT(squares("r.tks", 160), 0.8 * squares("s.tks", 160));  // 45 to 135 degrees east
    EXPECT_GT(squares("r.tks", 32), squares("s.tks", 32));
    const Outcome flat = cli("reorder s.tks -f -o r.tks --view top");
    EXPECT_EQ(flat.code, domain == std::string("cube") ? 1 : 0) << flat.err;
  }
  EXPECT_EQ(cli("reorder s.tks -f -o r.tks --globe --view top").code, 1);
  EXPECT_EQ(cli("reorder s.tks -f -o r.tks --globe --exaggeration 0 --cameras c.json").code, 1);
  std::ofstream(path("c.json")) << R"({"cameras": [{"eye": [0, 0, 2e7], "target": [0, 0, 4e7]}]})";
  const Outcome blind = cli("reorder s.tks -f -o r.tks --globe --cameras c.json");
  EXPECT_EQ(blind.code, 1);
  EXPECT_NE(blind.err.find("sees no ground"), std::string::npos) << blind.err;
}

TEST_F(CliGlobe, RefusesWhatIsNone) {
  ASSERT_EQ(encode(ground(36, 0, 1, "EPSG:4326")).code, 0);
  const Outcome run = cli("decode s.tks -f --mesh m.glb --globe");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("round a globe"), std::string::npos) << run.err;
  EXPECT_EQ(cli("decode s.tks -f --mesh m.glb --exaggeration 3").code, 1);
  EXPECT_EQ(cli("decode s.tks -f --mesh m.glb --globe --view low").code, 1);
  EXPECT_EQ(cli("decode s.tks -f --mesh m.glb --globe --exaggeration 0").code, 1);
  world_.crs = "EPSG:3857";
  ASSERT_EQ(encodeCube(" --bytes 4000 --domain cylinder").code, 0);
  const Outcome map = cli("decode s.tks -f --mesh m.glb --globe");
  EXPECT_EQ(map.code, 1);
  EXPECT_NE(map.err.find("no angles"), std::string::npos) << map.err;
}

/// A texture of longitudes and latitudes lies under its own place of a cube, whole or in part, also
/// where it goes on across 180 degrees and where its rows shrink to the poles.
TEST_F(CliCube, TexturesLieOverIt) {
  tools::ImageFile image;
  image.width = 64;
  image.height = 32;
  image.channels = 1;
  image.data.resize(64 * 32);
  for (const double west : {-180., 20.}) {
    image.place.geotransform = tools::GeoTransform{west, 360. / 64, 0, 90, 0, -180. / 32};
    ASSERT_TRUE(tools::writeImage(path("t.tif"), image).ok());
    ASSERT_EQ(encodeCube(" --bytes 6000 --texture t.tif").code, 0);
    EXPECT_EQ(domainOf("texture"), "cylinder");
    ASSERT_EQ(cli("decode s.tks -f --mesh m.obj --globe --triangles 900").code, 0);
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<double, 2>> places;
    size_t corners = 0;
    std::ifstream file(path("m.obj"));
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        auto& p = points.emplace_back();
        words >> p[0] >> p[1] >> p[2];
      } else if (kind == "vt") {
        auto& p = places.emplace_back();
        words >> p[0] >> p[1];
      } else if (kind == "f") {
        std::array<size_t, 3> v;
        for (size_t& corner : v) {
          std::string text;
          words >> text;
          corner = std::stoul(text) - 1;
        }
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const size_t corner : v) {
          ++corners;
          const auto [x, y, z] = points[corner];
          const double across = std::hypot(x, z), u = places[corner][0];
          least = std::min(least, u);
          most = std::max(most, u);
          EXPECT_NEAR(places[corner][1], 0.5 + std::atan2(y, across) / std::numbers::pi, 0.003);
          if (across < 1e3) continue;  // a pole
          const double east = std::atan2(-z, x) / (2 * std::numbers::pi) - west / 360;
          EXPECT_NEAR(std::remainder(u - east, 1), 0, 1e-4);
        }
        EXPECT_LT(most - least, 0.5);
      }
    }
    EXPECT_GT(corners, 1500u);
  }
  // One that covers the whole grid, without a place of its own.
  image.place = {};
  ASSERT_TRUE(tools::writeImage(path("whole.png"), image).ok());
  ASSERT_EQ(encodeCube(" --bytes 6000 --texture whole.png").code, 0);
  ASSERT_EQ(cli("decode s.tks -f --texture e.tif").code, 0);
  EXPECT_EQ(*tools::readImage(path("e.tif"))->place.geotransform,
            (tools::GeoTransform{-180, 360. / 64, 0, 90, 0, -180. / 32}));
}

TEST_F(CliCube, RefusesWhatDoesNotGoWithIt) {
  const auto refuses = [&](const std::string& options, const char* word) {
    const Outcome run = encodeCube(options);
    EXPECT_EQ(run.code, 1) << options;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  };
  refuses(" --lossless", "--lossless");
  refuses(" --max-error 3", "--max-error");
  refuses(" --bytes 3000 --nodata 2000", "void");
  refuses(" --bytes 3000 --crs EPSG:3857", "angles");
  (*world_.geotransform)[1] = 4;
  refuses(" --bytes 3000", "round");
  EXPECT_EQ(cli("encode g.tif --depth 4 --bytes 3000 -f -o s.tks").code, 1);
}

}  // namespace
}  // namespace tetrakis::test
