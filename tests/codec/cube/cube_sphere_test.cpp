// SPDX-License-Identifier: Apache-2.0
// The six patches cover the sphere: what is glued lies in one place, and directions come back.
#include "codec/cube/cube_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace tetrakis::test {
namespace {

SpherePoint pointOfSample(const Forest& cube, const Forest::Place& sample) {
  const double n = cube.side() - 1;
  return pointOf(sample.patch, offMiddle(static_cast<double>(sample.x) / n),
                 offMiddle(static_cast<double>(sample.y) / n));
}

double distance(const SpherePoint& a, const SpherePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(CubeSphere, GluedSamplesLieInOnePlace) {
  for (int depth = 1; depth <= 6; ++depth) {
    const Forest cube = cubeForest(depth);
    ASSERT_EQ(cube.patches(), kCubePatches);
    EXPECT_EQ(std::count(kCubeSides.begin(), kCubeSides.end(), Forest::kBorder), 0);
    cube.forEachShared(cube.side() - 1, [&](const Forest::Place& a, const Forest::Place& b) {
      EXPECT_LT(distance(pointOfSample(cube, a), pointOfSample(cube, b)), 1e-12);
    });
  }
}

TEST(CubeSphere, ThreePatchesMeetAtEachCorner) {
  const Forest cube = cubeForest(2);
  std::map<std::array<int64_t, 3>, int> corners;
  for (uint32_t patch = 0; patch < kCubePatches; ++patch) {
    for (const int64_t x : {0, 4}) {
      for (const int64_t y : {0, 4}) {
        const Forest::Place owner = cube.owner(4, {patch, x, y});
        ++corners[{owner.patch, owner.x, owner.y}];
      }
    }
  }
  EXPECT_EQ(corners.size(), 8u);
  for (const auto& corner : corners) EXPECT_EQ(corner.second, 3);
}

/// Across a side samples follow each other, so that all patches have one face
/// outside.
TEST(CubeSphere, LinesGoOnAcrossSides) {
  const Forest cube = cubeForest(5);
  const int64_t n = cube.side() - 1;
  for (uint32_t patch = 0; patch < kCubePatches; ++patch) {
    for (int64_t k = 0; k <= n; ++k) {
      for (const Forest::Place& outside :
           {Forest::Place{patch, k, -1}, Forest::Place{patch, n + 1, k},
            Forest::Place{patch, k, n + 1}, Forest::Place{patch, -1, k}}) {
        Forest::Place edge = outside;
        edge.x = std::clamp<int64_t>(edge.x, 0, n);
        edge.y = std::clamp<int64_t>(edge.y, 0, n);
        const SpherePoint across = pointOfSample(cube, cube.locate(n, outside));
        EXPECT_LT(distance(across, pointOfSample(cube, edge)), 1.6 / static_cast<double>(n));
      }
    }
  }
}

TEST(CubeSphere, PatchesHaveTheirPlaces) {
  const auto middle = [](uint32_t patch) { return geographicOf(pointOf(patch, 0, 0)); };
  for (uint32_t patch = 0; patch < 4; ++patch) {
    EXPECT_EQ(middle(patch).longitude, patch < 3 ? 90.0 * patch : -90);
    EXPECT_EQ(middle(patch).latitude, 0);
    // North is up, and east is right.
    EXPECT_GT(pointOf(patch, 0, -0.5).z, 0);
    EXPECT_GT(geographicOf(pointOf(patch, 0.1, 0)).longitude,
              patch == 2 ? -180 : middle(patch).longitude);
  }
  EXPECT_EQ(middle(4).latitude, 90);
  EXPECT_EQ(middle(5).latitude, -90);
}

TEST(CubeSphere, PlacesComeBack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inside(0.001, 0.999);
  for (int i = 0; i < 10000; ++i) {
    const CubePlace place{static_cast<uint32_t>(i) % kCubePatches, inside(random), inside(random)};
    const CubePlace back =
        cubePlaceOf(pointOf(place.patch, offMiddle(place.x), offMiddle(place.y)));
    EXPECT_EQ(back.patch, place.patch);
    EXPECT_NEAR(back.x, place.x, 1e-14);
    EXPECT_NEAR(back.y, place.y, 1e-14);
  }
}

TEST(CubeSphere, LongitudesAndLatitudesComeBack) {
  for (double latitude = -90; latitude <= 90; latitude += 1.25) {
    for (double longitude = -180; longitude <= 180; longitude += 1.25) {
      const SpherePoint point = pointOf(Geographic{longitude, latitude});
      EXPECT_NEAR(std::hypot(point.x, point.y, point.z), 1, 1e-15);
      const Geographic back = geographicOf(point);
      EXPECT_NEAR(back.latitude, latitude, 1e-12);
      if (std::abs(latitude) == 90) continue;
      EXPECT_NEAR(std::remainder(back.longitude - longitude, 360), 0, 1e-12);
      const CubePlace place = cubePlaceOf(point);
      EXPECT_LT(distance(pointOf(place.patch, offMiddle(place.x), offMiddle(place.y)), point),
                1e-14);
    }
  }
}

/// The areas of all samples, of which those on sides lie half in a patch, are that of the sphere;
/// and near a place the area is that of a small square there.
TEST(CubeSphere, AreasOfSamplesCoverTheSphere) {
  constexpr uint32_t kSide = 65;
  const std::vector<float> areas = patchAreas(kSide);
  ASSERT_EQ(areas.size(), size_t{kSide} * kSide);
  const double step = std::numbers::pi / 2 / (kSide - 1);
  double sum = 0;
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const auto part = [](uint32_t at) { return at == 0 || at + 1 == kSide ? 0.5 : 1.0; };
      sum += part(x) * part(y) * areas[y * kSide + x] * step * step;
    }
  }
  EXPECT_NEAR(6 * sum, 4 * std::numbers::pi, 2e-3);
  EXPECT_EQ(areas[kSide / 2 * kSide + kSide / 2], 1);
  const auto at = [](double x, double y) { return pointOf(2, offMiddle(x), offMiddle(y)); };
  constexpr double kSmall = 1e-4;
  for (const auto& [x, y] : {std::pair(0u, 0u), {7u, 40u}, {64u, 30u}, {33u, 5u}}) {
    const double u = x / 64.0, v = y / 64.0;
    const double east = distance(at(u - kSmall, v), at(u + kSmall, v)),
                 south = distance(at(u, v - kSmall), at(u, v + kSmall)),
                 across = distance(at(u - kSmall, v - kSmall), at(u + kSmall, v + kSmall));
    const double cosine = (across * across - east * east - south * south) / (2 * east * south);
    const double area =
        east * south * std::sqrt(1 - cosine * cosine) / std::pow(std::numbers::pi * kSmall, 2);
    EXPECT_NEAR(areas[y * kSide + x], area, 1e-3) << x << ", " << y;
  }
}

TEST(CubeSphere, QuarterTurnsAreExact) {
  for (int turns = -9; turns <= 9; ++turns) {
    const double degrees = 90.0 * turns;
    EXPECT_EQ(sineOfDegrees(degrees), turns % 2 == 0 ? 0 : (turns - 1) % 4 == 0 ? 1 : -1);
    EXPECT_EQ(cosineOfDegrees(degrees), turns % 2 != 0 ? 0 : turns % 4 == 0 ? 1 : -1);
  }
}

}  // namespace
}  // namespace tetrakis::test
