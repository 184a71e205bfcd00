// SPDX-License-Identifier: Apache-2.0
// Which step suits files that join several sources, and smooth ones.
#include "codec/geometry/quantiser/step_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace tetrakis::test {
namespace {

constexpr uint32_t kSideOfSteps = 160;

std::vector<float> floats(const std::function<double(uint32_t x, uint32_t y, double ground)>& of) {
  std::vector<float> heights;
  uint32_t noise = 1;
  for (uint32_t y = 0; y < kSideOfSteps; ++y) {
    for (uint32_t x = 0; x < kSideOfSteps; ++x) {
      noise = noise * 1664525 + 1013904223;
      const double ground = 900 + 70 * std::sin(x / 9. + y / 23.) + 50 * std::cos(y / 7.) +
                            (noise >> 8) * 0x1p-24 * 9;
      heights.push_back(static_cast<float>(of(x, y, ground)));
    }
  }
  return heights;
}

HeightSteps stepsOf(const std::vector<float>& heights, bool lossless = true) {
  tks_heights source = {};
  source.size = sizeof source;
  source.width = source.height = kSideOfSteps;
  source.sample = TKS_F32;
  source.data = heights.data();
  source.scale = 1;
  return *toSteps(source, {.lossless = lossless, .table = lossless});
}

double wholeIn(double unit, double ground) {
  return unit * std::round(ground / unit);
}

TEST(OtherSteps, TakeTheStepOfThePartThatHasOne) {
  for (const double unit : {1.0, 0.1}) {
    const HeightSteps steps = stepsOf(floats([&](uint32_t x, uint32_t y, double ground) {
      return (x / 40 + y / 40) % 3 == 0 ? ground : wholeIn(unit, ground);
    }));
    EXPECT_EQ(steps.step, unit);
    EXPECT_FALSE(steps.exact) << "corrections restore the others";
  }
}

/// Heights in fives of metres, or areas in cells of 900 square metres.
TEST(OtherSteps, OfMultiplesAreTheirGreatestCommonDivisor) {
  for (const double step : {5.0, 2.5, 0.3, 900.0}) {
    for (const bool lossless : {true, false}) {
      const HeightSteps steps = stepsOf(floats([&](uint32_t, uint32_t, double ground) {
                                          return step * std::round(ground - 700);
                                        }),
                                        lossless);
      EXPECT_NEAR(steps.step, step, 1e-12 * step);
      EXPECT_TRUE(steps.exact) << step;
    }
  }
}

/// Rounded ones would need corrections that take more bits than the fine step does.
TEST(OtherSteps, KeepFineStepsOfOthers) {
  const auto ground = [](uint32_t, uint32_t, double height) { return height; };
  const double fine = stepsOf(floats(ground)).step;
  EXPECT_LT(fine, 1e-2);
  const HeightSteps few = stepsOf(floats([&](uint32_t x, uint32_t, double height) {
    return x % 16 == 0 ? wholeIn(1, height) : height;
  }));
  EXPECT_EQ(few.step, fine);
  const HeightSteps flat = stepsOf(floats(
      [&](uint32_t x, uint32_t, double height) { return x < kSideOfSteps / 2 ? 700 : height; }));
  EXPECT_EQ(flat.step, fine) << "flat ground has no step";
}

/// Steps that restore every sample in few bits stay: metres beside centimetres.
TEST(OtherSteps, KeepExactStepsThatAreNearlyAsCoarse) {
  const HeightSteps steps = stepsOf(floats([&](uint32_t x, uint32_t y, double ground) {
    return (x / 40 + y / 40) % 2 == 0 ? wholeIn(0.1, ground) : wholeIn(1, ground);
  }));
  EXPECT_TRUE(steps.exact || !steps.table.empty());
}

/// Planes that floats round: corrections know nothing of them, coefficients do.
TEST(OtherSteps, AreFinerForPlanes) {
  const auto plane = [](uint32_t x, uint32_t y, double) { return 1 + x * 0.110317 + y * 0.091733; };
  const auto rough = [](uint32_t x, uint32_t, double height) {
    return std::fmod(height * 50, 33) + 1 + x * 1e-3;
  };
  EXPECT_LT(16 * stepsOf(floats(plane)).step, 1.01 * stepsOf(floats(rough)).step);
}

TEST(OtherSteps, AreForLosslessHeightsAlone) {
  const std::vector<float> heights = floats([&](uint32_t x, uint32_t y, double ground) {
    return (x / 40 + y / 40) % 3 == 0 ? ground : wholeIn(1, ground);
  });
  EXPECT_LT(stepsOf(heights, false).step, 1e-2);
}

}  // namespace
}  // namespace tetrakis::test
