// SPDX-License-Identifier: Apache-2.0
// Units of steps, against the formulas of docs/FORMAT.md, section 8.1, and against doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/step_units.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {
namespace {

__extension__ typedef __int128 Wide;

/// n * 2^shift, halves up, clamped.
int64_t expectedScaled(int64_t n, int shift, int64_t limit) {
  if (shift < -100) return 0;
  if (shift > 62) return n == 0 ? 0 : n < 0 ? -limit : limit;
  const Wide scaled =
      shift >= 0 ? Wide{n} * (Wide{1} << shift) : (Wide{n} + (Wide{1} << (-shift - 1))) >> -shift;
  return static_cast<int64_t>(std::clamp(scaled, Wide{-limit}, Wide{limit}));
}

TEST(StepUnits, ScaleByPowersOfTwo) {
  Random random(1);
  for (int round = 0; round < 100000; ++round) {
    const auto n = static_cast<int64_t>(uint64_t{random()} << 32 | random()) >> random() % 64;
    const int shift = static_cast<int>(random() % 180) - 90;
    for (const int64_t limit : {kFar, kWide})
      ASSERT_EQ(scaled(n, shift, limit), expectedScaled(n, shift, limit)) << n << ", " << shift;
  }
  for (const int64_t n :
       {std::numeric_limits<int64_t>::min(), int64_t{0}, std::numeric_limits<int64_t>::max()}) {
    for (int shift = -2000; shift <= 2000; ++shift)
      ASSERT_EQ(scaled(n, shift), expectedScaled(n, shift, kFar)) << n << ", " << shift;
  }
}

/// Every digit that a float has counts, whatever the unit is.
TEST(StepUnits, FloatsComeBackFromUnits) {
  Random random(2);
  for (int round = 0; round < 100000; ++round) {
    const auto sample = std::bit_cast<float>(static_cast<uint32_t>(random()) & 0xbfffffff);
    const int exponent = spacingExponent(sample) - static_cast<int>(random() % 30);
    if (sample == 0) continue;
    ASSERT_EQ(nearestFloat(inUnits(sample, exponent), exponent), sample);
  }
}

/// Steps have 31 digits in units: a height is off by a unit and 2^-30 of its way from the base.
TEST(StepUnits, SamplesNearStepsAreThoseOfDoubles) {
  for (const double base : {0.0, 812.7, -1e5, 31.0417}) {
    for (const double step : {1.0, 0.2, 0.3048, 0.001, 255.0}) {
      const StepGrid grid(base, step);
      for (int32_t q = -70000; q < 70000; q += 7) {
        const double exact = base + q * step;
        const double off = (std::abs(q) + 1) * step * 0x1p-30;
        ASSERT_NEAR(grid.sampleNear<float>(q), exact, off + std::abs(exact) * 0x1p-24);
        ASSERT_NEAR(grid.sampleNear<int32_t>(q), exact, 0.5 + off);
        if (std::abs(exact) * 0x1p-23 < step) {
          ASSERT_EQ(grid.nearest(restore<float>(base, step, q)), q) << base << " + q * " << step;
        }
      }
    }
  }
}

/// No base, step or sample leads beyond 64 bits: the sanitizers look.
TEST(StepUnits, TakeAnyNumbers) {
  constexpr double kNumbers[] = {5e-324, 1e-310, 1e-30, 1, 1e30, 1.7e308};
  for (const double base : kNumbers) {
    for (const double step : kNumbers) {
      const StepGrid up(base, step), down(-base, step);
      for (const int32_t q :
           {std::numeric_limits<int32_t>::min(), -1, 0, std::numeric_limits<int32_t>::max()}) {
        EXPECT_LE(down.sampleNear<float>(q), up.sampleNear<float>(q));
        EXPECT_LE(std::abs(up.inUnitsOf(-1100, q)), kFar);
        EXPECT_EQ(down.inUnitsOf(1100, q), 0);
      }
      for (const uint32_t bits : {0u, 1u, 0x7f7fffffu, 0x7f800000u, 0xff800000u, 0x7fffffffu}) {
        const auto steps = up.nearest(std::bit_cast<float>(bits), 16);
        EXPECT_LE(std::abs(steps), 1 << 29);
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
