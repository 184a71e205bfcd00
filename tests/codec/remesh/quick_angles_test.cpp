// SPDX-License-Identifier: Apache-2.0
// Quick angles are those of the C library, but for the eighth digit.
#include "codec/remesh/quick_angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tetrakis {
namespace {

constexpr double kPi = 3.141592653589793;

TEST(QuickAngles, AreAnglesToEightDigits) {
  for (int k = 0; k <= 10000; ++k) {
    const double angle = kPi * k / 10000, radius = 1e-3 * (1 + k);
    const double y = std::max(0.0, std::sin(angle));
    EXPECT_NEAR(quickAngle(radius * std::cos(angle), radius * y), angle, 3e-8);
  }
  EXPECT_EQ(quickAngle(0, 0), kPi / 2);
  EXPECT_EQ(quickAngle(-1, 0), kPi);
}

TEST(QuickAngles, DirectionsHaveTheLengthOne) {
  for (int k = -10000; k <= 10000; ++k) {
    const double angle = kPi * k / 10000;
    const FlatPoint direction = quickDirection(angle);
    EXPECT_NEAR(direction.x, std::cos(angle), 3e-8);
    EXPECT_NEAR(direction.y, std::sin(angle), 3e-8);
    EXPECT_NEAR(direction.x * direction.x + direction.y * direction.y, 1, 1e-14);
  }
}

}  // namespace
}  // namespace tetrakis
