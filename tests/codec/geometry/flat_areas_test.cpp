// SPDX-License-Identifier: Apache-2.0
// The layer of flat areas: what is found, and what comes back of it.
#include <gtest/gtest.h>

#include "codec/geometry/coding_choice/flat_choice.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

constexpr Size kMaskSizes[] = {{1, 1}, {1, 9},   {9, 1},   {2, 2},
                               {5, 3}, {40, 23}, {64, 65}, {2, 300}};

/// Random heights, of which some are equal.
FlatAreas areasOf(const std::vector<uint8_t>& flat, const Size& size, Random& random) {
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, size.extent()));
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  for (int32_t& height : areas.heights)
    height = random() % 3 == 0 ? 5 : static_cast<int32_t>(random() >> random() % 32);
  return areas;
}

TEST(FlatAreas, AreNumberedByTheirFirstSamples) {
  const std::vector<uint8_t> flat = {1, 0, 1, 1, 0,  //
                                     1, 0, 0, 1, 0,  //
                                     1, 1, 0, 0, 1,  //
                                     0, 1, 1, 1, 1};
  const NumberedAreas areas = numberAreas(PlaneView<const uint8_t>(flat, Extent{5, 4}));
  EXPECT_EQ(areas.count, 2u);
  EXPECT_EQ(areas.numbers, (std::vector<uint16_t>{1, 0, 2, 2, 0, 1, 0, 0, 2, 0,  //
                                                  1, 1, 0, 0, 1, 0, 1, 1, 1, 1}));
}

TEST(FlatAreas, ComeBackAndNoPrefixShowsOthers) {
  Random random(1);
  for (const Size& size : kMaskSizes) {
    for (const VoidShape shape : kVoidShapes) {
      for (const VoidShape voids : {VoidShape::kOneVoid, VoidShape::kSpeckle}) {
        const std::vector<uint8_t> valid = validity(voids, size.width, size.height);
        std::vector<uint8_t> flat = validity(shape, size.width, size.height);
        for (size_t i = 0; i < flat.size(); ++i) flat[i] &= valid[i];
        const FlatAreas areas = areasOf(flat, size, random);
        if (areas.heights.empty()) continue;
        const auto count = static_cast<uint32_t>(areas.heights.size());
        const std::vector<uint8_t> codeword = encodeFlatAreas(areas, size.extent(), valid);
        const SharedBits bits = sharedBits(valid, size.extent());
        const FlatAreas decoded = decodeFlatAreas(codeword, size.extent(), bits, count);
        ASSERT_EQ(decoded.numbers, areas.numbers) << size << ", " << shape;
        ASSERT_EQ(decoded.heights, areas.heights) << size << ", " << shape;
        EXPECT_TRUE(decodeFlatAreas(codeword, size.extent(), bits, count + 1).empty());
        for (size_t bytes = 0; bytes < codeword.size(); bytes += 1 + codeword.size() / 20) {
          const FlatAreas some =
              decodeFlatAreas(std::span(codeword).first(bytes), size.extent(), bits, count);
          ASSERT_TRUE(some.empty() || some.heights == areas.heights) << size << ", " << bytes;
        }
      }
    }
  }
}

/// Areas of random heights of few values on forests: they go on across sides, are alike where
/// patches share a sample, and come back from the mask of what is owned.
TEST(FlatAreas, OfForestsGoOnAcrossSides) {
  Random random(4);
  for (const ForestShape& shape : forestShapes()) {
    for (const int depth : {1, 2, 3}) {
      const Forest forest(depth, shape.sides);
      const Extent raster = forest.raster();
      Plane heights = randomPlane(random, raster.samples(), 0, 2);
      shareOwned(forest, std::span(heights), forest.side() - 1);
      const FlatFinder finder({heights, raster}, &forest);
      const FlatAreas areas = finder.areas({1}, {0, 0, raster.width, raster.height});
      if (areas.empty()) continue;
      std::vector<uint16_t> shared = areas.numbers;
      shareOwned(forest, std::span(shared), forest.side() - 1);
      ASSERT_EQ(shared, areas.numbers) << shape.name << depth;
      for (size_t i = 0; i < shared.size(); ++i) {
        if (shared[i] != 0) {
          ASSERT_EQ(areas.heights[shared[i] - 1u], heights[i]) << shape.name << depth;
        }
      }
      const SharedBits owned = tetrakis::shared(ownedSamples(forest));
      const std::vector<uint8_t> codeword = encodeFlatAreas(areas, raster, owned->bytes());
      const FlatAreas decoded = decodeFlatAreas(
          codeword, raster, owned, static_cast<uint32_t>(areas.heights.size()), &forest);
      ASSERT_EQ(decoded.numbers, areas.numbers) << shape.name << depth;
      ASSERT_EQ(decoded.heights, areas.heights) << shape.name << depth;
    }
  }
}

TEST(FlatAreas, OfOneHeightAreOneOnAForest) {
  for (const ForestShape& shape : forestShapes()) {
    const Forest forest(2, shape.sides);
    const std::vector<uint8_t> flat(forest.raster().samples(), 1);
    EXPECT_EQ(numberAreas(PlaneView<const uint8_t>(flat, forest.raster()), &forest).count, 1u)
        << shape.name;
  }
}

TEST(FlatAreas, AreFoundAndNeverTouchOthersOfAnotherHeight) {
  Random random(2);
  const Size size{50, 41};
  Plane heights = randomPlane(random, size.count(), 0, 1);  // many areas, of all sizes
  const std::vector<uint8_t> valid = validity(VoidShape::kCoast, size.width, size.height);
  const FlatFinder finder({heights, size.extent(), valid});
  const Window whole{0, 0, size.width, size.height};
  for (const uint32_t least : {1u, 8u, 64u}) {
    const FlatAreas areas = finder.areas({least}, whole);
    for (size_t i = 0; i < areas.numbers.size(); ++i) {
      if (areas.numbers[i] == 0) continue;
      ASSERT_TRUE(valid[i]);
      ASSERT_EQ(areas.heights[areas.numbers[i] - 1u], heights[i]);
    }
  }
  EXPECT_TRUE(finder.areas({10000}, whole).empty());
}

TEST(FlatAreas, AreChosenWhereTheyPayAlone) {
  Random random(3);
  const Size size{128, 128};
  Plane land = randomPlane(random, size.count(), 0, 4000), lake = land;
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 40; x < 100; ++x) lake[size_t{y} * size.width + x] = 17;
  }
  const HeightPurpose purpose{12, Purpose::kLossless};
  EXPECT_TRUE(chooseFlatAreas({land, size.extent()}, {}, purpose).flat.codeword.empty());
  EXPECT_EQ(chooseFlatAreas({lake, size.extent()}, {}, purpose).flat.areas.heights,
            std::vector<int32_t>{17});
}

/// Large planes are tried on a few parts; ponds that lie in some of them alone are found.
TEST(FlatAreas, TilesStandForAPlane) {
  Random random(4);
  const Size size{900, 700};
  Plane land = randomPlane(random, size.count(), 0, 4000), ponds = land;
  size_t count = 0, water = 0;
  for (uint32_t y = 300; y < 660; ++y) {
    for (uint32_t x = 400; x < 860; ++x) {
      if (x % 40 >= 20 || y % 40 >= 20) continue;
      ponds[size_t{y} * size.width + x] = 4017;
      count += x % 40 == 0 && y % 40 == 0;
      ++water;
    }
  }
  const FlatFinder finder({ponds, size.extent()});
  ASSERT_EQ(finder.samplesOf(64, {0, 0, size.width, size.height}), water);
  double stand_for = 0, flat = 0;
  const auto parts = sampleParts(finder, 64, 8);
  EXPECT_GT(parts.size(), 1u);
  for (const auto& [window, times] : parts) {
    ASSERT_TRUE(window.isInside(size.extent()));
    stand_for += times * static_cast<double>(window.extent().samples());
    flat += times * static_cast<double>(finder.samplesOf(64, window));
  }
  EXPECT_NEAR(stand_for, static_cast<double>(size.count()), 1e-6 * stand_for);
  EXPECT_NEAR(flat, static_cast<double>(water), 0.3 * flat);
  const HeightPurpose purpose{12, Purpose::kLossless};
  EXPECT_TRUE(chooseFlatAreas({land, size.extent()}, {}, purpose).flat.codeword.empty());
  EXPECT_EQ(chooseFlatAreas({ponds, size.extent()}, {}, purpose).flat.areas.heights,
            std::vector<int32_t>(count, 4017));
}

/// Half a plane of water in few bytes: the shape that is sent is simpler than the shore, most of
/// the water is of it, and all of it is water.
TEST(FlatAreas, AreSimplerWhereBytesAreFew) {
  const Size size{300, 280};
  Plane coast(size.count());
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x)
      coast[size_t{y} * size.width + x] = static_cast<int32_t>(samples::ridges(x, y, 5) / 32);
  }
  Plane sorted = coast;
  const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (int32_t& height : coast) height = std::max(height - *middle, 0);
  const double water = 0.5 * static_cast<double>(size.count());
  const PlaneView<const int32_t> plane(coast, size.extent());
  const std::vector<uint8_t> whole = encodeFlatAreas(
      FlatFinder(plane).areas({64}, {0, 0, size.width, size.height}), size.extent(), {});
  const FlatLayer few = chooseFlatAreas(plane, {}, {11, Purpose::kLossy, 2500, 0, 1, true}).flat;
  EXPECT_LT(2 * few.codeword.size(), whole.size());
  double held = 0;
  for (size_t i = 0; i < coast.size(); ++i) {
    const uint16_t number = few.areas.empty() ? 0 : few.areas.numbers[i];
    if (number == 0) continue;
    ++held;
    ASSERT_EQ(coast[i], few.areas.heights[number - 1u]);
  }
  EXPECT_GT(held, 0.5 * water);
}

}  // namespace
}  // namespace tetrakis::test
