// SPDX-License-Identifier: Apache-2.0
// The encoder's choice of filters: what it depends on, and that it is always a legal one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::VoidShape;

constexpr Size kSize{200, 180};
constexpr Purpose kPurposes[] = {Purpose::kLossless, Purpose::kLossy};

template <class F>
Plane planeOf(const Size& size, F f) {
  Plane plane;
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x) plane.push_back(static_cast<int32_t>(f(x, y)));
  }
  return plane;
}

/// A surface with nothing near its highest frequency.
Plane oversampled() {
  return planeOf(kSize, [](double x, double y) {
    return 9000 * (std::sin(0.7 * x + 0.02 * y * y) + std::sin(0.5 * y) * std::cos(0.3 * x));
  });
}

/// Few colours, vertical walls.
Plane drawn() {
  return planeOf(kSize, [](uint32_t x, uint32_t y) {
    return samples::patternValue({samples::Pattern::kSteps, 0, 0}, x, y, 0) >> 8;
  });
}

/// Flat roofs on gentle, noisy ground.
Plane town() {
  Random random(7);
  return planeOf(kSize, [&](uint32_t x, uint32_t y) {
    const uint32_t lot = (x / 25) * 31 + (y / 23) * 17;
    const bool roof = x % 25 < 9 + lot % 11 && y % 23 < 8 + lot % 13;
    return (roof ? 3000 + 400 * (lot % 9) : 1000 + x + y / 2) + random() % 5;
  });
}

/// A round hill, and no noise.
Plane hill() {
  return planeOf(kSize, [](uint32_t x, uint32_t y) {
    const double dx = x - 90.0, dy = y - 70.0;
    return 40000 * std::exp(-(dx * dx + dy * dy) / 3000);
  });
}

std::array<uint8_t, 3> all(FilterId id) {
  const auto i = static_cast<uint8_t>(id);
  return {i, i, i};
}

TEST(FilterChoice, SuitsThePlane) {
  const auto choose = [](const Plane& plane, Purpose purpose) {
    return chooseWavelet({plane, kSize.extent()}, 16, purpose).filters;
  };
  EXPECT_EQ(choose(drawn(), Purpose::kLossless), all(FilterId::kShort));
  EXPECT_EQ(choose(oversampled(), Purpose::kLossless), all(FilterId::kLong));
  EXPECT_EQ(choose(oversampled(), Purpose::kLossy)[0], static_cast<uint8_t>(FilterId::kLong));
  EXPECT_NE(choose(drawn(), Purpose::kLossy), all(FilterId::kLong));
  EXPECT_EQ(choose(town(), Purpose::kLossy), all(FilterId::kShort));
  EXPECT_EQ(choose(hill(), Purpose::kLossy), all(FilterId::kSmooth));
}

/// Coarse levels of images have the nearly orthogonal filter of little noise, level 2 only where
/// many bits are lossless, and no level where there are steps.
TEST(FilterChoice, OfLosslessImagesLooksAtTheirPrefixes) {
  const auto choose = [](const Plane& plane) {
    const PlaneView<const int32_t> view(plane, kSize.extent());
    return chooseLosslessWavelet(std::span(&view, 1), 8).filters;
  };
  const auto surface = [](double height) {
    return planeOf(kSize, [height](double x, double y) {
      const double grain = std::sin(12.9898 * x + 78.233 * y) * 43758.5453;
      return height * (std::sin(0.05 * x) + std::cos(0.04 * y) + (grain - std::floor(grain)) / 8);
    });
  };
  EXPECT_EQ(choose(surface(60))[1], static_cast<uint8_t>(FilterId::kQuiet));
  EXPECT_NE(choose(surface(5))[1], static_cast<uint8_t>(FilterId::kQuiet));
  EXPECT_EQ(choose(drawn()), all(FilterId::kShort));
}

TEST(FilterChoice, IsDeterministic) {
  for (const Plane& plane : {oversampled(), drawn()}) {
    for (const Purpose purpose : kPurposes) {
      const WaveletHeader a = chooseWavelet({plane, kSize.extent()}, 16, purpose),
                          b = chooseWavelet({plane, kSize.extent()}, 16, purpose);
      EXPECT_EQ(a.filters, b.filters);
      EXPECT_EQ(a.bits, b.bits);
      EXPECT_EQ(a.fraction_bits, b.fraction_bits);
    }
  }
}

void expectLegal(const WaveletHeader& header, int bits, Purpose purpose) {
  for (const uint8_t filter : header.filters) EXPECT_LT(filter, kFilters);
  EXPECT_EQ(header.bits, bits + header.fraction_bits);
  EXPECT_TRUE(purpose == Purpose::kLossy || header.fraction_bits == 0);
  EXPECT_LE(header.bits, std::max(20, bits)) << "fraction bits stay below the widest samples";
  for (const FilterId growing : {FilterId::kQuiet, FilterId::kOrthogonal})
    EXPECT_TRUE(bits <= 20 || header.filters[2] != static_cast<uint8_t>(growing));
}

TEST(FilterChoice, TinyAndConstantPlanesAreLegal) {
  Random random(1);
  for (const Size& size : {Size{1, 1}, Size{1, 2}, Size{2, 1}, Size{4, 4}, Size{5, 1}, Size{1, 300},
                           Size{300, 2}, Size{33, 33}}) {
    for (const Purpose purpose : kPurposes) {
      for (const int bits : {1, 8, 16, 20, 27}) {
        const int32_t most = (1 << bits) - 1;
        for (const Plane& plane : {Plane(size.count(), 0), Plane(size.count(), most),
                                   randomPlane(random, size.count(), 0, most)}) {
          const auto choose = [&](Mask valid) {
            return chooseWavelet({plane, size.extent(), valid}, bits, purpose);
          };
          expectLegal(choose({}), bits, purpose);
          for (const VoidShape shape : samples::kVoidShapes) {
            expectLegal(choose(samples::validity(shape, size.width, size.height)), bits, purpose);
          }
        }
      }
    }
  }
}

/// What stands in voids does not matter.
TEST(FilterChoice, IgnoresVoids) {
  Random random(2);
  const auto valid = samples::validity(VoidShape::kCoast, kSize.width, kSize.height);
  for (const Plane& clean : {oversampled(), drawn()}) {
    Plane noisy = clean, quiet = clean;
    const Plane noise = randomPlane(random, kSize.count(), 0, 65535);
    for (size_t i = 0; i < valid.size(); ++i) {
      if (valid[i]) continue;
      noisy[i] = noise[i];
      quiet[i] = 0;
    }
    for (const Purpose purpose : kPurposes) {
      EXPECT_EQ(chooseWavelet({noisy, kSize.extent(), valid}, 16, purpose).filters,
                chooseWavelet({quiet, kSize.extent(), valid}, 16, purpose).filters);
    }
  }
}

/// A lake in the middle does not decide for the hills around it, and the other way round.
TEST(FilterChoice, FlatPartsDoNotDecide) {
  const Size large{600, 520};
  const Plane hills =
      planeOf(large, [](double x, double y) { return 5000 * std::sin(0.9 * x + 0.1 * y); });
  for (const Purpose purpose : kPurposes) {
    const auto choose = [&](const Plane& plane) {
      return chooseWavelet({plane, large.extent()}, 16, purpose).filters;
    };
    Plane lake = hills, coast = hills;
    for (uint32_t y = 0; y < large.height; ++y) {
      for (uint32_t x = 0; x < large.width; ++x) {
        const bool middle = x > 200 && x < 400 && y > 170 && y < 350;
        (middle ? lake : coast)[size_t{y} * large.width + x] = 0;
      }
    }
    EXPECT_EQ(choose(lake), choose(hills));
    EXPECT_EQ(choose(coast), choose(hills));
  }
}

TEST(TypicalParts, LieInThePlaneAndApart) {
  for (const Size& size : {Size{1, 1}, Size{256, 256}, Size{257, 1}, Size{2, 5000}, Size{257, 256},
                           Size{300, 289}, Size{4097, 2049}, Size{1u << 21, 3}}) {
    std::vector<Window> parts = typicalParts(size.extent());
    ASSERT_FALSE(parts.empty());
    uint64_t samples = 0;
    for (const Window& part : parts) {
      ASSERT_GT(part.width, 0u);
      ASSERT_GT(part.height, 0u);
      ASSERT_LE(uint64_t{part.x} + part.width, size.width);
      ASSERT_LE(uint64_t{part.y} + part.height, size.height);
      samples += uint64_t{part.width} * part.height;
      for (const Window& other : parts) {
        const bool apart = &part == &other || part.x + part.width <= other.x ||
                           other.x + other.width <= part.x || part.y + part.height <= other.y ||
                           other.y + other.height <= part.y;
        ASSERT_TRUE(apart);
      }
    }
    EXPECT_LE(samples, 9u * 96 * 96);
  }
}

}  // namespace
}  // namespace tetrakis::test
