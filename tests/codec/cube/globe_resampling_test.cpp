// SPDX-License-Identifier: Apache-2.0
// Heights of geographic grids come to the cube and back, wherever the grid begins and ends and
// however it runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "codec/cube/cube_from_grid.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "codec/cube/grid_from_cube.hpp"

namespace tetrakis::test {
namespace {

using Transform = std::array<double, 6>;

GeographicGrid gridOf(const Extent& extent, const Transform& transform) {
  Result<GeographicGrid> grid = GeographicGrid::make(extent, transform);
  EXPECT_TRUE(grid.ok()) << grid.status().message();
  return *grid;
}

/// A height of no symmetry, without a break anywhere on the sphere.
double smoothHeight(const SpherePoint& d) {
  return 1000 * (d.x * d.y + 0.5 * d.z * d.z * d.x + std::sin(3 * d.y + d.z) + 0.3 * d.z);
}

std::vector<float> smoothHeights(const GeographicGrid& grid) {
  std::vector<float> heights;
  for (uint32_t y = 0; y < grid.extent().height; ++y)
    for (uint32_t x = 0; x < grid.extent().width; ++x)
      heights.push_back(static_cast<float>(
          smoothHeight(pointOf(Geographic{grid.longitudeOf(x), grid.latitudeOf(y)}))));
  return heights;
}

struct OnCube {
  Forest cube;
  std::vector<float> samples;
  ResamplingErrors errors;
};

OnCube onCube(const GeographicGrid& grid, const std::vector<float>& heights, int depth,
              uint32_t threads = 1) {
  const Forest cube = cubeForest(depth);
  const HeightsOnCube made = cubeFromGrid(grid, heights, cube, threads);
  return {cube, made.samples, made.errors};
}

std::vector<float> onGrid(const OnCube& from, const GeographicGrid& grid, uint32_t threads = 1) {
  std::vector<float> heights(grid.extent().samples());
  gridFromCube(from.cube, from.samples, grid, {0, 0, grid.extent()}, threads, heights);
  return heights;
}

template <class Visit>
void forEachSample(const Forest& cube, const Visit& visit) {
  const double n = cube.side() - 1;
  for (size_t i = 0; i < cube.raster().samples(); ++i) {
    const size_t row = i / cube.side();
    visit(i, pointOf(static_cast<uint32_t>(row / cube.side()),
                     offMiddle(static_cast<double>(i % cube.side()) / n),
                     offMiddle(static_cast<double>(row % cube.side()) / n)));
  }
}

struct Named {
  const char* name;
  Extent extent;
  Transform transform;
  double most = 1;  ///< that heights are off
};

constexpr double kCell = 2.5;  // degrees
const Named kGrids[] = {
    {"cells", {144, 72}, {-180, kCell, 0, 90, 0, -kCell}},
    {"points", {144, 73}, {-kCell / 2, kCell, 0, 90 + kCell / 2, 0, -kCell}},
    {"points, and the first column again", {145, 73}, {0, kCell, 0, 90 + kCell / 2, 0, -kCell}},
    {"south up", {144, 72}, {0, kCell, 0, -90, 0, kCell}},
    {"westwards", {144, 72}, {180, -kCell, 0, 90, 0, -kCell}},
    {"odd", {145, 72}, {17.3, 360.0 / 145, 0, 90, 0, -kCell}},
    {"far round", {144, 72}, {720 - 33.1, kCell, 0, 90, 0, -kCell}},
    {"a part of a row from the poles", {144, 72}, {0, kCell, 0, 89.2, 0, -178.4 / 72}, 20}};

TEST(GlobeResampling, SmoothHeightsAreThoseOfTheirPlaces) {
  for (const Named& given : kGrids) {
    SCOPED_TRACE(given.name);
    const GeographicGrid grid = gridOf(given.extent, given.transform);
    const std::vector<float> heights = smoothHeights(grid);
    const OnCube made = onCube(grid, heights, 5);
    forEachSample(made.cube, [&](size_t i, const SpherePoint& point) {
      ASSERT_NEAR(made.samples[i], smoothHeight(point), given.most) << i;
    });
    const std::vector<float> back = onGrid(made, grid);
    double largest = 0;
    for (size_t i = 0; i < heights.size(); ++i)
      largest = std::max(largest, std::abs(double{heights[i]} - back[i]));
    EXPECT_LT(largest, given.most);
    EXPECT_NEAR(made.errors.largest, largest, 1e-3);
    EXPECT_LT(made.errors.rmse, 0.2);
  }
}

TEST(GlobeResampling, SharedSamplesAreEqual) {
  std::mt19937 random(1);
  const GeographicGrid grid = gridOf({64, 32}, {-180, 5.625, 0, 90, 0, -5.625});
  std::vector<float> noise(grid.extent().samples());
  for (float& height : noise) height = static_cast<float>(random() % 1000);
  for (int depth = 1; depth <= 6; ++depth) {
    const OnCube made = onCube(grid, noise, depth);
    std::vector<float> shared = made.samples;
    shareOwned<float>(made.cube, shared, made.cube.side() - 1);
    EXPECT_EQ(shared, made.samples);
  }
}

TEST(GlobeResampling, ThreadsChangeNothing) {
  std::mt19937 random(2);
  const GeographicGrid grid = gridOf({90, 45}, {-180, 4, 0, 90, 0, -4});
  std::vector<float> noise(grid.extent().samples());
  for (float& height : noise) height = static_cast<float>(random() % 1000);
  const OnCube one = onCube(grid, noise, 5), more = onCube(grid, noise, 5, 4);
  EXPECT_EQ(one.samples, more.samples);
  EXPECT_EQ(onGrid(one, grid), onGrid(one, grid, 4));
}

TEST(GlobeResampling, WindowsAreThoseOfTheWhole) {
  const GeographicGrid grid = gridOf({145, 73}, {0, kCell, 0, 90 + kCell / 2, 0, -kCell});
  const OnCube made = onCube(grid, smoothHeights(grid), 4);
  const std::vector<float> whole = onGrid(made, grid);
  const GridWindow window{100, 60, {45, 13}};
  std::vector<float> part(window.extent.samples());
  gridFromCube(made.cube, made.samples, grid, window, 2, part);
  for (uint32_t y = 0; y < window.extent.height; ++y)
    for (uint32_t x = 0; x < window.extent.width; ++x)
      EXPECT_EQ(part[y * window.extent.width + x], whole[(window.y + y) * 145 + window.x + x]);
}

/// A sample of a cube that is much coarser than the grid is about the mean of the samples around:
/// of noise it keeps little, and what is smooth beside the noise comes out of it.
TEST(GlobeResampling, CoarseCubesTakeMeans) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 1000);
  const GeographicGrid grid = gridOf({360, 180}, {-180, 1, 0, 90, 0, -1});
  std::vector<float> heights = smoothHeights(grid);
  for (float& height : heights) height += noise(random);
  const OnCube made = onCube(grid, heights, 4);
  double squares = 0;
  forEachSample(made.cube, [&](size_t i, const SpherePoint& point) {
    const double off = made.samples[i] - smoothHeight(point);
    squares += off * off;
  });
  EXPECT_LT(std::sqrt(squares / static_cast<double>(made.samples.size())), 350);
}

/// A cube that is finer than the grid goes nearly through its samples, however rough they are.
TEST(GlobeResampling, FineCubesKeepSamples) {
  std::mt19937 random(4);
  std::normal_distribution<float> noise(0, 1000);
  const GeographicGrid grid = gridOf({64, 32}, {-180, 5.625, 0, 90, 0, -5.625});
  std::vector<float> heights(grid.extent().samples());
  for (float& height : heights) height = noise(random);
  const double coarse = onCube(grid, heights, 4).errors.rmse;
  const double middle = onCube(grid, heights, 5).errors.rmse;
  const double fine = onCube(grid, heights, 6).errors.rmse;
  EXPECT_LT(coarse, 700);
  EXPECT_LT(middle, 300);
  EXPECT_LT(fine, 100);
}

/// Where the grid ends before a pole its last row turns into its mean.
TEST(GlobeResampling, GoesOnToThePoles) {
  const GeographicGrid grid = gridOf({72, 20}, {-180, 5, 0, 50, 0, -5});
  std::vector<float> heights;
  for (uint32_t y = 0; y < 20; ++y)
    for (uint32_t x = 0; x < 72; ++x) heights.push_back(y == 0 && x < 36 ? 300.f : 100.f);
  const OnCube made = onCube(grid, heights, 5);
  forEachSample(made.cube, [&](size_t i, const SpherePoint& point) {
    const Geographic place = geographicOf(point);
    if (place.latitude > 89.9) {
      EXPECT_NEAR(made.samples[i], 200, 1e-2);
    }
    if (place.latitude < -60) {
      EXPECT_NEAR(made.samples[i], 100, 1e-2);
    }
    EXPECT_GT(made.samples[i], 50);
    EXPECT_LT(made.samples[i], 350);
  });
}

TEST(GlobeResampling, ConstantHeightsStayAsTheyAre) {
  const GeographicGrid grid = gridOf({50, 30}, {-180, 7.2, 0, 70, 0, -5});
  for (const float height : {0.0f, -4321.5f, 1e-40f, 1e29f}) {
    const OnCube made = onCube(grid, std::vector<float>(grid.extent().samples(), height), 3);
    for (const float sample : made.samples)
      ASSERT_NEAR(sample, height, 1e-6 * std::abs(double{height}) + 1e-44);
  }
}

TEST(GlobeResampling, RefusesOtherGrids) {
  const auto refuses = [](const Extent& extent, const Transform& transform) {
    return GeographicGrid::make(extent, transform).status().code() == TKS_USAGE;
  };
  EXPECT_FALSE(refuses({72, 36}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({72, 1}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({0, 36}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({71, 36}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({74, 36}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({72, 36}, {0, 5, 0.1, 90, 0, -5}));
  EXPECT_TRUE(refuses({72, 36}, {0, 5, 0, 90, 0, 0}));
  EXPECT_TRUE(refuses({72, 36}, {0, 5, 0, 95, 0, -5}));
  EXPECT_TRUE(refuses({72, 38}, {0, 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({72, 36}, {std::numeric_limits<double>::infinity(), 5, 0, 90, 0, -5}));
  EXPECT_TRUE(refuses({72, 36}, {0, 5, 0, std::nan(""), 0, -5}));
}

}  // namespace
}  // namespace tetrakis::test
