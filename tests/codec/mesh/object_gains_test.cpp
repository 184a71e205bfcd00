// SPDX-License-Identifier: Apache-2.0
// The rasters by which vertices of objects are chosen: heights along the normals of patches.
#include "codec/mesh/forest/object_gains.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "codec/mesh/forest/forest_mesh.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

/// Samples of a grid that is uneven within a plane: x and y are `bend` off even steps in the middle
/// of the patch. lift: height above the plane in the middle.
ObjectRasters bentGrid(const Forest& forest, double bend, double lift) {
  ObjectRasters places;
  const double n = forest.side() - 1;
  for (uint32_t i = 0; i < forest.raster().samples(); ++i) {
    const double u = i % forest.side() / n, v = i / forest.side() / n;
    const double hill = 16 * u * (1 - u) * v * (1 - v);
    const double x = 4000 * u + bend * hill, y = 4000 * v + bend * hill, z = lift * hill;
    // A plane that leans: (2, 1, -2) / 3 is its normal.
    const double turned[3] = {(2 * x + y + 2 * z) / 3, (-2 * x + 2 * y + z) / 3,
                              (x + 2 * y - 2 * z) / 3};
    for (size_t axis = 0; axis < 3; ++axis)
      places[axis].push_back(static_cast<int32_t>(std::floor(turned[axis] + 0.5)));
  }
  return places;
}

double gainsOf(const ForestLattice& lattice, const std::vector<int32_t>& raster) {
  double sum = 0;
  for (const double gain : forestGains(lattice, raster)) sum += gain;
  return sum;
}

TEST(ObjectGains, AreThoseOfHeightsAlongTheNormal) {
  const Forest forest(4, planeShape(1, 1).sides);
  const ForestLattice lattice(forest);
  const double within = gainsOf(lattice, coordinatesOfErrors(forest, bentGrid(forest, 300, 0))[0]);
  const double above = gainsOf(lattice, coordinatesOfErrors(forest, bentGrid(forest, 0, 300))[0]);
  EXPECT_GT(above, 1e4);
  EXPECT_LT(within, above / 1000);
}

/// What a patch without an area, or one that folds, has beside its normal.
TEST(ObjectGains, CountAlongTheAxesByAPart) {
  const Forest forest(3, planeShape(1, 2).sides);
  ObjectRasters places;
  for (size_t axis = 0; axis < 3; ++axis) places[axis].assign(forest.raster().samples(), 400);
  const auto rasters = coordinatesOfErrors(forest, places);
  EXPECT_EQ(rasters[0], std::vector<int32_t>(places[0].size()));
  for (size_t axis = 1; axis < 4; ++axis) EXPECT_EQ(rasters[axis][5], 100);
}

TEST(ObjectGains, HaveRoomForTheFarthestPlaces) {
  constexpr int32_t kFar = 1 << 30;
  const Forest forest(1, planeShape(1, 1).sides);
  ObjectRasters places;
  for (uint32_t i = 0; i < 9; ++i) {
    places[0].push_back(i % 3 == 0 ? -kFar : kFar);
    places[1].push_back(i / 3 == 0 ? -kFar : kFar);
    places[2].push_back(i == 0 ? kFar : -kFar);
  }
  const auto rasters = coordinatesOfErrors(forest, places);
  for (const int32_t height : rasters[0]) EXPECT_LE(std::abs(double{1} * height), 2.0 * kFar);
}

}  // namespace
}  // namespace tetrakis::test
