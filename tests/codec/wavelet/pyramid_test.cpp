// SPDX-License-Identifier: Apache-2.0
// The pyramid of levels: its bands and masks, and what views show of a plane.
#include "codec/wavelet/pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

TEST(Subbands, TileThePlaneCoarsestFirst) {
  for (uint32_t height = 1; height <= 70; ++height) {
    for (uint32_t width = 1; width <= 70; ++width) {
      std::vector<int> coefficients(size_t{width} * height, 0), samples = coefficients;
      const std::vector<Subband> bands = subbandsOf(Size{width, height});
      for (size_t i = 0; i < bands.size(); ++i) {
        const Subband& band = bands[i];
        ASSERT_EQ(static_cast<size_t>(band.orientation), i == 0 ? 0 : (i - 1) % 3 + 1);
        ASSERT_EQ(band.level, bands[0].level - (i == 0 ? 0 : static_cast<int>((i - 1) / 3)));
        forEachCoefficient(band, width, [&](size_t coefficient, size_t sample) {
          ++coefficients.at(coefficient);
          ++samples.at(sample);
        });
      }
      const auto once = static_cast<ptrdiff_t>(coefficients.size());
      ASSERT_EQ(std::count(coefficients.begin(), coefficients.end(), 1), once);
      ASSERT_EQ(std::count(samples.begin(), samples.end(), 1), once);
      ASSERT_LE(std::max(bands[0].width, bands[0].height), kSmallestSide);
    }
  }
}

TEST(Subbands, TheLargestSidesHaveLevelsEnough) {
  for (const Size& size : {Size{1u << 21, 1}, Size{1, 1u << 21}, Size{(1u << 21) - 1, 5}}) {
    const std::vector<Subband> bands = subbandsOf(size);
    ASSERT_LE(bands.front().level, kMaxLevels);
    size_t count = 0;
    for (const Subband& band : bands) count += size_t{band.width} * band.height;
    EXPECT_EQ(count, size.count());
  }
}

/// The low band of a level, out of the coefficients of the whole plane.
ViewSynthesis lowBandOf(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                        const Plane& coefficients) {
  ViewSynthesis synthesis(spec, pyramid, {level, {}});
  synthesis.allocate();
  for (const Subband& subband : pyramid.subbands()) {
    for (uint32_t row = 0; row < synthesis.needed(subband).height; ++row)
      std::copy_n(coefficients.data() + pyramid.indexOf(subband, row), subband.width,
                  synthesis.row(subband, row).begin());
  }
  return synthesis;
}

/// Whatever the filters and doublings of the finer levels.
TEST(ViewSynthesis, ConstantsKeepTheirValueAtEveryLevel) {
  for (const WaveletSpec& spec : allSpecs()) {
    for (const Size& size : {Size{64, 64}, Size{77, 40}, Size{5, 100}, Size{3, 9}}) {
      const Pyramid pyramid(size.extent());
      for (int level = 0; level <= pyramid.levels(); ++level) {
        for (const int32_t constant : {-3000, 1, 77, 20000}) {
          const Plane plane = forward(spec, Plane(size.count(), constant), size);
          const Plane low = lowBandOf(spec, pyramid, level, plane).run(1);
          ASSERT_EQ(low.size(), (View{level, {}}.extentIn(size.extent()).samples()));
          for (const int32_t value : low)
            ASSERT_NEAR(value, constant, std::abs(constant) / 2000 + 2) << spec << level;
        }
      }
    }
  }
}

/// The subbands of a level fill its low band, each coefficient once.
TEST(Pyramid, SubbandsOfALevelTileItsLowBand) {
  for (const Size& size : {Size{1, 1}, Size{64, 64}, Size{77, 40}, Size{5, 100}, Size{300, 9}}) {
    const Pyramid pyramid(size.extent());
    ASSERT_EQ(coarsestLevel(size.extent()), pyramid.levels());
    for (int level = 0; level <= pyramid.levels(); ++level) {
      std::vector<int> seen(pyramid.low(level).extent.samples(), 0);
      for (const Subband& subband : pyramid.subbands()) {
        if (!pyramid.isIn(subband, level)) continue;
        for (uint32_t row = 0; row < subband.height; ++row) {
          for (uint32_t x = 0; x < subband.width; ++x)
            ++seen.at(pyramid.indexOf(subband, row, level) + x);
        }
      }
      EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ssize(seen)) << size << level;
    }
  }
}

/// Every value of a block has the mark of its sample, wherever the block lies.
TEST(Pyramid, MasksAreLaidOutLikeTheValuesOfTheirBlock) {
  Random random(12);
  for (const Size& size : {Size{45, 38}, Size{4, 60}, Size{60, 3}}) {
    std::vector<uint8_t> valid(size.count());
    for (uint8_t& v : valid) v = random() % 2;
    const Pyramid pyramid(size.extent(), valid);
    for (int level = 0; level < pyramid.levels(); ++level) {
      const LowBand& band = pyramid.low(level);
      const bool split = pyramid.splitsX(level + 1);
      for (const uint32_t x0 : {0u, split ? 2u : 1u}) {
        const Window block{x0, 1, band.extent.width - x0, band.extent.height - 1};
        const std::vector<uint8_t> mask = pyramid.splitMask(level, block);
        const uint32_t lows = split ? (block.width + 1) / 2 : block.width;
        for (uint32_t i = 0; i < block.extent().samples(); ++i) {
          const uint32_t x = i % block.width, y = block.y + i / block.width;
          const uint32_t column = !split ? x : x < lows ? 2 * x : 2 * (x - lows) + 1;
          const size_t sample =
              (size_t{y} << band.splits_y) * size.width + (size_t{x0 + column} << band.splits_x);
          ASSERT_EQ(mask[i], valid[sample]) << size << ": level " << level << " from " << x0;
        }
      }
    }
  }
}

/// A view that shows nothing but some samples shows those of the whole plane.
TEST(View, CutsWhatItShows) {
  const Extent plane{7, 5};
  std::vector<int> values(plane.samples());
  std::iota(values.begin(), values.end(), 0);
  const std::span<const int> all(values);
  EXPECT_EQ(slice(all, plane, {}), values);
  EXPECT_EQ(slice(all, plane, {1, {}}), (std::vector{0, 2, 4, 6, 14, 16, 18, 20, 28, 30, 32, 34}));
  EXPECT_EQ(slice(all, plane, {0, Window{5, 3, 2, 2}}), (std::vector{26, 27, 33, 34}));
  EXPECT_TRUE(slice(std::span<const int>(), plane, {1, {}}).empty());
  EXPECT_FALSE((Window{5, 3, 3, 2}.isInside(plane)));
  EXPECT_FALSE((Window{UINT32_MAX, 0, 1, 1}.isInside(plane)));
  EXPECT_FALSE((Window{0, 0, 0, 1}.isInside(plane)));
}

}  // namespace
}  // namespace tetrakis::test
