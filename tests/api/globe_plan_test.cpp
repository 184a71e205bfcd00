// SPDX-License-Identifier: Apache-2.0
// tks_plan and tks_reorder of cameras that look at a globe.
#include <array>
#include <cmath>
#include <numbers>

#include "base/vec3.hpp"
#include "conformance/samples/header_seal.hpp"
#include "ratecontrol/receiver/globe_sight.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/globe_grids.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tests/support/planned_ranges.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr double kRadius = 1737400;

Vec3 towards(double longitude, double latitude) {
  const double degree = std::numbers::pi / 180, across = std::cos(latitude * degree);
  return {across * std::cos(longitude * degree), across * std::sin(longitude * degree),
          std::sin(latitude * degree)};
}

/// From so many radii above a place towards the centre, 40 degrees high.
std::array<double, 16> clipAbove(double longitude, double latitude, double radii) {
  const Vec3 out = towards(longitude, latitude), eye = scale(out, radii * kRadius);
  const Vec3 right = normalized(cross({0, 0, 1}, out)), up = cross(out, right);
  const double tall = 1 / std::tan(std::numbers::pi / 9), wide = tall * 200 / 320;
  const auto row = [&](const Vec3& axis, double by) {
    return std::array{axis[0] * by, axis[1] * by, axis[2] * by, -dot(axis, eye) * by};
  };
  std::array<double, 16> clip{};
  std::copy_n(row(right, wide).begin(), 4, clip.begin());
  std::copy_n(row(up, tall).begin(), 4, clip.begin() + 4);
  std::copy_n(row(out, -1).begin(), 4, clip.begin() + 12);
  return clip;
}

tks_screen_camera cameraAbove(const tks_globe& globe, double longitude, double latitude,
                              double radii) {
  tks_screen_camera camera = cameraOf(clipAbove(longitude, latitude, radii));
  camera.width = 1600;  // so that no detail is finer than a pixel
  camera.height = 1000;
  camera.globe = &globe;
  return camera;
}

/// Of heights whose columns begin at longitude 0 or -180, in regions.
constexpr Grid kFine{192, 96, -180, 90, 1.875, -1.875};
constexpr Grid kTurned{192, 97, 0, -90.9375, 1.875, 1.875};

tks_encode_options indexed() {
  tks_encode_options options = lossless();
  options.regions = 16;
  options.index = TKS_INDEX_PACKETS;
  return options;
}

struct Earth {
  Grid grid;
  Raster raster = rasterOf(grid);
  Bytes bytes = encodeHeights(placed(raster, grid), indexed());
  size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  tks_globe globe = moon();

  /// Squared error of what lies within `angle` degrees of a place.
  double errorAbout(Stream& stream, double longitude, double latitude, double angle) const {
    const std::vector<std::byte> decoded = stream.heights();
    const Vec3 middle = towards(longitude, latitude);
    const double most = std::cos(angle * std::numbers::pi / 180);
    double sum = 0;
    for (uint32_t i = 0; i < grid.width * grid.height; ++i) {
      const Vec3 at = towards(grid.west + (i % grid.width + 0.5) * grid.column,
                              grid.north + (i / grid.width + 0.5) * grid.row);
      if (dot(at, middle) < most) continue;
      sum += std::pow(sampleAt(decoded, raster.sample, i) - sampleAt(raster.data, raster.sample, i),
                      2);
    }
    return sum;
  }
};

TEST(GlobePlan, WhatFacesTheCameraComesFirst) {
  for (const Grid& grid : {kFine, kTurned}) {
    const Earth earth{grid};
    for (const auto& [longitude, latitude] :
         {std::pair{0.0, 10.0}, {180.0, -20.0}, {-95.0, 40.0}, {60.0, 0.0}}) {
      SCOPED_TRACE(testing::Message() << grid.west << ": " << longitude << ", " << latitude);
      const tks_screen_camera view = cameraAbove(earth.globe, longitude, latitude, 3);
      Stream stream(Prefix(earth.bytes).first(earth.header));
      const size_t budget = earth.bytes.size() / 4;
      const Ranges plan(stream, &view, budget);
      ASSERT_EQ(plan.bytes(), budget);
      for (const tks_range& range : plan.all())
        ASSERT_NO_FATAL_FAILURE(put(stream, earth.bytes, range));
      Stream prefix(Prefix(earth.bytes).first(earth.header + budget));
      EXPECT_LT(earth.errorAbout(stream, longitude, latitude, 40),
                0.5 * earth.errorAbout(prefix, longitude, latitude, 40));
      EXPECT_GT(earth.errorAbout(stream, longitude + 180, -latitude, 40),
                earth.errorAbout(prefix, longitude + 180, -latitude, 40));
    }
  }
}

TEST(GlobePlan, TheFarSideGainsNothing) {
  const Earth earth{kFine};
  Stream stream(Prefix(earth.bytes).first(earth.header));
  double before = 1;
  for (const double radii : {4.0, 2.0, 1.3}) {  // the nearer, the less is seen
    const tks_screen_camera view = cameraAbove(earth.globe, 180, 0, radii);
    const Ranges plan(stream, &view, UINT64_MAX);
    double seen = 0;
    for (const tks_range& range : plan.all())
      seen += range.gain > 0 ? static_cast<double>(range.size) : 0;
    const double share = seen / static_cast<double>(plan.bytes());
    EXPECT_LT(share, before) << radii;
    before = share;
  }
  EXPECT_LT(before, 0.5);
}

TEST(GlobePlan, CoversEveryByteOfGridsAndCubes) {
  const Earth earth{kFine};
  const ForestRaster cube(Forest(6, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  const Raster image = make({Pattern::kRidges, 128, 64, 3, TKS_U8});
  const tks_heights on_cube = cube.heights(), on_grid = placed(earth.raster, kFine);
  const tks_image texels = image.image();
  for (const Bytes& bytes :
       {encodeGiven(&on_grid, &texels, indexed()), encodeGiven(&on_cube, nullptr, indexed()),
        encodeGiven(&on_cube, &texels, indexed())}) {
    const tks_screen_camera view = cameraAbove(earth.globe, 20, 30, 2);
    Stream stream(Prefix(bytes).first(static_cast<size_t>(Stream(bytes).info().header_bytes)));
    for (int lap = 0; lap < 3; ++lap) {
      const Ranges plan(stream, &view, lap < 2 ? bytes.size() / 4 : UINT64_MAX, 300);
      for (const tks_range& range : plan.all()) ASSERT_NO_FATAL_FAILURE(put(stream, bytes, range));
    }
    EXPECT_TRUE(Ranges(stream, &view, UINT64_MAX).all().empty());
    Stream whole(bytes);
    EXPECT_EQ(stream.heights(), whole.heights());
    EXPECT_EQ(stream.texture(), whole.texture());
  }
}

/// The faces of a cube in regions that look at the camera come first.
TEST(GlobePlan, FacesOfACubeThatAreSeenComeFirst) {
  const ForestRaster cube(Forest(6, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  const Bytes bytes = cube.encoded(indexed());
  const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  const tks_globe globe = moon();
  const uint32_t side = cube.forest.side();
  const std::array<std::array<double, 3>, 6> middles = {
      {{0, 0, 2}, {90, 0, 3}, {180, 0, 0}, {-90, 0, 1}, {0, 89, 5}, {0, -89, 4}}};
  for (uint32_t patch = 0; patch < middles.size(); ++patch) {
    const auto& [longitude, latitude, opposite] = middles[patch];
    const tks_screen_camera view = cameraAbove(globe, longitude, latitude, 3);
    const size_t budget = bytes.size() / 4;
    Stream stream(Prefix(bytes).first(header)), prefix(Prefix(bytes).first(header + budget));
    const Ranges plan(stream, &view, budget);
    ASSERT_EQ(plan.bytes(), budget);
    for (const tks_range& range : plan.all()) ASSERT_NO_FATAL_FAILURE(put(stream, bytes, range));
    const auto errorOf = [&](Stream& of, uint32_t face) {
      return errorIn(cube.raster, of.heights(), {0, face * side, side, side});
    };
    EXPECT_LT(errorOf(stream, patch), 0.5 * errorOf(prefix, patch)) << patch;
    const auto hidden = static_cast<uint32_t>(opposite);
    EXPECT_GT(errorOf(stream, hidden), errorOf(prefix, hidden)) << patch;
  }
}

/// Of a texture of longitudes and latitudes over a cube the texels that are seen come first.
TEST(GlobePlan, KnowsWhereATextureOverACubeLies) {
  const ForestRaster cube(Forest(4, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  const Raster image = make({Pattern::kRidges, 256, 128, 3, TKS_U8});
  const tks_heights heights = cube.heights();
  const tks_globe globe = moon();
  for (const double west : {-180.0, 0.0}) {
    tks_image texels = image.image();
    texels.domain = TKS_DOMAIN_CYLINDER;
    texels.has_geotransform = 1;
    const std::array transform = {west, 1.40625, 0.0, 90.0, 0.0, -1.40625};
    std::copy(transform.begin(), transform.end(), texels.geotransform);
    const Bytes bytes = encodeGiven(&heights, &texels, indexed());
    const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    Stream stream(Prefix(bytes).first(header));
    const tks_screen_camera view = cameraAbove(globe, 45, 0, 3);
    const Ranges plan(stream, &view, bytes.size() / 12);
    for (const tks_range& range : plan.all()) ASSERT_NO_FATAL_FAILURE(put(stream, bytes, range));
    Stream prefix(Prefix(bytes).first(header + bytes.size() / 12));
    const auto first = static_cast<uint32_t>((45 - west) / 1.40625);
    const tks_window seen = {first - 16, 48, 32, 32};
    EXPECT_LT(errorIn(image, stream.texture(), seen), 0.5 * errorIn(image, prefix.texture(), seen))
        << west;
  }
}

TEST(GlobePlan, ReorderedStreamsServeTheCamera) {
  const Earth earth{kFine};
  Stream stream(earth.bytes);
  const tks_screen_camera view = cameraAbove(earth.globe, 180, 0, 3);
  tks_buffer buffer = {};
  ASSERT_EQ(tks_reorder(stream.get(), &view, 1, &buffer), TKS_OK) << tks_message(stream.get());
  const Bytes order(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  ASSERT_EQ(order.size(), earth.bytes.size());
  EXPECT_EQ(Stream(order).heights(), stream.heights());
  Stream a(Prefix(order).first(order.size() / 4)), b(Prefix(earth.bytes).first(order.size() / 4));
  EXPECT_LT(earth.errorAbout(a, 180, 0, 40), 0.5 * earth.errorAbout(b, 180, 0, 40));
}

/// The pixels of a square of a sphere are those between its projected corners, and it is seen
/// where the way from the eye to it misses the sphere.
TEST(GlobePlan, PointsOfASphereAreSeenAsTheyAreProjected) {
  GlobeGround ground{60, 28, {}};
  const auto at = [&](double x, double y) { return scale(towards(6 * x, 84 - 6 * y), kRadius); };
  for (uint32_t y = 0; y < ground.rows; ++y)
    for (uint32_t x = 0; x < ground.columns; ++x)
      ground.points.push_back({at(x, y), subtract(at(x + 0.05, y), at(x - 0.05, y)),
                               subtract(at(x, y + 0.05), at(x, y - 0.05)),
                               towards(6. * x, 84 - 6. * y)});
  Eye eye{clipAbove(70, -30, 4), 320, 200};
  const SeenRaster seen = sightOf(ground, eye);
  const auto pixel = [&](const Vec3& p) {
    const auto row = [&](size_t i) {
      return dot({eye.clip[i], eye.clip[i + 1], eye.clip[i + 2]}, p) + eye.clip[i + 3];
    };
    return Vec3{160 * row(0) / row(12), 100 * row(4) / row(12), 0};
  };
  const Vec3 from = scale(towards(70, -30), 4 * kRadius);
  size_t count = 0;
  for (uint32_t i = 0; i < seen.points.size(); ++i) {
    const double x = i % ground.columns, y = i / ground.columns;
    const double side = dot(from, at(x, y)) / (kRadius * kRadius);
    if (side < 0.999) {
      EXPECT_EQ(seen.points[i].pixels, 0);
    }
    if (side < 1.001) continue;
    const Vec3 a = subtract(pixel(at(x + 0.05, y + 0.05)), pixel(at(x - 0.05, y - 0.05)));
    const Vec3 b = subtract(pixel(at(x - 0.05, y + 0.05)), pixel(at(x + 0.05, y - 0.05)));
    const double pixels = length(cross(a, b)) / 2;
    EXPECT_NEAR(seen.points[i].pixels, pixels, 0.01 * pixels);
    ++count;
  }
  EXPECT_GT(count, 400u);
}

/// With the checksum repaired: whatever a header says of the place, the domain and the samples.
TEST(GlobePlan, SurvivesEveryDamagedByte) {
  const Grid grid{24, 12, -180, 90, 15, -15};
  const Raster raster = rasterOf(grid), image = make({Pattern::kSteps, 32, 16, 1, TKS_U8});
  const ForestRaster cube(Forest(3, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  const tks_heights on_grid = placed(raster, grid), on_cube = cube.heights();
  const tks_image texels = image.image();
  const tks_limits limits = smallLimits();
  const tks_globe globe = moon();
  const tks_screen_camera view = cameraAbove(globe, 20, 30, 2);
  for (const tks_heights* heights : {&on_grid, &on_cube}) {
    const Bytes bytes = encodeGiven(heights, &texels, indexed());
    const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    for (size_t at = 0; at < header; ++at) {
      for (const int flip : {0x01, 0x40, 0x90}) {
        Bytes damaged = bytes;
        damaged[at] = static_cast<uint8_t>(damaged[at] ^ flip);
        sealHeader(damaged);
        Stream stream(Prefix(damaged).first(flip == 0x40 ? header : bytes.size()), &limits);
        if (stream.status() != TKS_OK) continue;
        tks_ranges ranges = {};
        const tks_fetch fetch = {sizeof fetch, 700, 30, 0};
        tks_plan(stream.get(), &view, &fetch, &ranges);
        tks_free_ranges(&ranges);
        tks_buffer buffer = {};
        tks_reorder(stream.get(), &view, 1, &buffer);
        tks_free_buffer(&buffer);
      }
    }
  }
}

TEST(GlobePlan, WhatHasNoGlobeIsRefusedInASentence) {
  const Earth earth{kFine};
  const Bytes flat = encodeHeights(earth.raster.heights(), indexed());
  const tks_fetch fetch = {sizeof fetch, 1000, 0, 0};
  const auto refused = [&](const Bytes& bytes, const tks_globe& globe, const std::string& part) {
    Stream stream(bytes);
    const tks_screen_camera view = cameraAbove(globe, 0, 0, 3);
    tks_ranges ranges = {};
    EXPECT_EQ(tks_plan(stream.get(), &view, &fetch, &ranges), TKS_USAGE);
    EXPECT_NE(std::string(tks_message(stream.get())).find(part), std::string::npos)
        << tks_message(stream.get());
  };
  refused(flat, moon(), "do not go once round a globe");
  refused(earth.bytes, {sizeof(tks_globe), 0, 1, 0, 0}, "The axes of a globe");
  refused(earth.bytes, {3, 1, 1, 0, 0}, "The struct of the globe");
  const ForestRaster torus(Forest(3, torusShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  refused(torus.encoded(lossless()), moon(), "not those of a globe on a cube");
  Stream stream(flat);
  const tks_globe globe = moon();
  const tks_screen_camera view = cameraAbove(globe, 0, 0, 3);
  const tks_screen screen = {sizeof screen, &view, 1, nullptr};
  tks_mesh mesh = {};
  EXPECT_EQ(tks_decode_screen_mesh(stream.get(), &screen, 100, &mesh), TKS_UNSUPPORTED);
}

}  // namespace
}  // namespace tetrakis::test
