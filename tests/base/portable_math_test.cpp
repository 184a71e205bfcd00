// SPDX-License-Identifier: Apache-2.0
// Functions that give the same bits everywhere. The values to the last bit are those of MPFR.
#include "base/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tetrakis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PortableMath, LogarithmsAreRoundedToNearest) {
  EXPECT_EQ(portable::log(0.7), -0x1.6d3c324e13f5p-2);
  EXPECT_EQ(portable::log(3), 0x1.193ea7aad030bp+0);
  EXPECT_EQ(portable::log2(0.1), -0x1.a934f0979a371p+1);
  EXPECT_EQ(portable::log2(1e-310), -0x1.01730dabca5f6p+10);
  EXPECT_EQ(portable::log2(12345.678), 0x1.b2ef5b86e63dp+3);
  EXPECT_EQ(portable::log10(2), 0x1.34413509f79ffp-2);
  EXPECT_EQ(portable::log10(7e300), 0x1.2cd858585bc66p+8);
}

TEST(PortableMath, PowersAreRoundedToNearest) {
  EXPECT_EQ(portable::exp(1), 0x1.5bf0a8b145769p+1);
  EXPECT_EQ(portable::exp(-20.3), 0x1.a3b8dc86d1c8fp-30);
  EXPECT_EQ(portable::exp2(0.3), 0x1.3b2c47bff8329p+0);
  EXPECT_EQ(portable::exp2(-1000.7), 0x1.3b2c47bff827ap-1001);
  EXPECT_EQ(portable::pow(10, 22), 1e22);
  EXPECT_EQ(portable::pow(10, -300), 1e-300);
}

TEST(PortableMath, AnglesAreRoundedToNearest) {
  EXPECT_EQ(portable::tan(0.4), 0x1.b0f0b49dcdcd8p-2);
  EXPECT_EQ(portable::tan(1.5), 0x1.c33ed50b88777p+3);
  EXPECT_EQ(portable::sin(0.5), 0x1.eaee8744b05fp-2);
  EXPECT_EQ(portable::sin(-3), -0x1.210386db6d55bp-3);
  EXPECT_EQ(portable::cos(0.5), 0x1.c1528065b7d5p-1);
  EXPECT_EQ(portable::cos(3), -0x1.fae04be85e5d2p-1);
  EXPECT_EQ(portable::atan(0.2), 0x1.94441f8f7260cp-3);
  EXPECT_EQ(portable::atan(-7), -0x1.6dcc57bb565fdp+0);
}

TEST(PortableMath, AreThoseOfTheCLibraryButForTheLastBit) {
  const auto near = [](double got, double wanted) {
    EXPECT_NEAR(got, wanted, std::abs(wanted) * 0x1p-51);
  };
  for (int i = 1; i < 3000; ++i) {
    const double x = 0.0123 * i;
    near(portable::log(x), std::log(x));
    near(portable::log2(1 / x), std::log2(1 / x));
    near(portable::log10(x), std::log10(x));
    near(portable::exp(-x), std::exp(-x));
    near(portable::exp2(x), std::exp2(x));
    near(portable::pow(x, 1.1), std::pow(x, 1.1));
    near(portable::tan(0.0005 * i), std::tan(0.0005 * i));
    near(portable::sin(0.001 * i), std::sin(0.001 * i));
    near(portable::cos(0.001 * i), std::cos(0.001 * i));
    near(portable::atan(x), std::atan(x));
  }
}

TEST(PortableMath, PowersOfTwoAreExact) {
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    const double power = std::ldexp(1, exponent);
    EXPECT_EQ(portable::log2(power), exponent);
    EXPECT_EQ(portable::exp2(exponent), power);
  }
}

TEST(PortableMath, EndsAreThoseOfTheCLibrary) {
  EXPECT_EQ(portable::log2(0), -kInfinity);
  EXPECT_EQ(portable::log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(portable::log10(-1)));
  EXPECT_EQ(portable::exp(-kInfinity), 0);
  EXPECT_EQ(portable::exp(1000), kInfinity);
  EXPECT_EQ(portable::exp2(-2000), 0);
  EXPECT_EQ(portable::exp2(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(portable::exp(std::nan(""))));
  EXPECT_EQ(portable::pow(0, 0), 1);
  EXPECT_EQ(portable::pow(0, 2), 0);
  EXPECT_EQ(portable::pow(0, -2), kInfinity);
  EXPECT_EQ(portable::pow(kInfinity, -2), 0);
  EXPECT_EQ(portable::atan(0), 0);
}

}  // namespace
}  // namespace tetrakis
