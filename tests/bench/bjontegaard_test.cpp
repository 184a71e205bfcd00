// SPDX-License-Identifier: Apache-2.0
// The Bjøntegaard rate difference on curves whose answer is known, and the properties of its parts.
#include "bench/harness/bjontegaard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tetrakis::bench {
namespace {

using Curve = std::vector<RatePoint>;

// A concave curve like a codec's: psnr = 20 + 9 log2(1 + 8 rate) at rates 0.02 * 2^(i / 2).
Curve codecCurve(double rate_factor, int points = 16) {
  Curve curve;
  for (int i = 0; i < points; ++i) {
    const double rate = 0.02 * std::pow(2.0, i / 2.0);
    curve.push_back({rate * rate_factor, 20 + 9 * std::log2(1 + 8 * rate)});
  }
  return curve;
}

std::vector<double> risingValues(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> step(1e-3, 10);
  std::vector<double> values{step(random)};
  while (static_cast<int>(values.size()) < n) values.push_back(values.back() + step(random));
  return values;
}

TEST(MonotoneCubic, MatchesHandComputedPchip) {
  // Secants 1, 3, 5; slopes 0, 2*1*3/4, 2*3*5/8, 6.
  const MonotoneCubic f({0, 1, 2, 3}, {0, 1, 4, 9});
  EXPECT_DOUBLE_EQ(f.at(0.5), 0.5 + (0 - 1.5) / 8);
  EXPECT_DOUBLE_EQ(f.at(1.5), 2.5 + (1.5 - 3.75) / 8);
  EXPECT_DOUBLE_EQ(f.at(2.5), 6.5 + (3.75 - 6) / 8);
}

TEST(MonotoneCubic, PassesThroughItsDataAndStaysMonotone) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 12;
    const std::vector<double> x = risingValues(random, n), y = risingValues(random, n);
    const MonotoneCubic f(x, y);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(f.at(x[i]), y[i], 1e-9);
    double last = f.at(f.low());
    for (int i = 1; i <= 500; ++i) {
      const double now = f.at(f.low() + (f.high() - f.low()) * i / 500);
      EXPECT_GE(now, last - 1e-9);
      last = now;
    }
  }
}

TEST(MonotoneCubic, IntegralIsTheAreaBelow) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const MonotoneCubic f(risingValues(random, 7), risingValues(random, 7));
    const double from = f.low() + 0.2 * (f.high() - f.low());
    const double to = f.high() - 0.1 * (f.high() - f.low());
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += f.at(from + (to - from) * (i + 0.5) / n);
    EXPECT_NEAR(f.integral(from, to), sum * (to - from) / n, 1e-6 * std::abs(sum));
  }
}

TEST(ParetoFront, KeepsExactlyTheUnbeatenPoints) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> coordinate(1, 20);
  for (int trial = 0; trial < 200; ++trial) {
    Curve points(30);
    for (RatePoint& p : points) p = {double(coordinate(random)), double(coordinate(random))};
    const Curve front = paretoFront(points);
    for (size_t i = 1; i < front.size(); ++i) {
      EXPECT_GT(front[i].rate, front[i - 1].rate);
      EXPECT_GT(front[i].psnr, front[i - 1].psnr);
    }
    for (const RatePoint& p : points) {
      bool covered = false;
      for (const RatePoint& f : front) covered |= f.rate <= p.rate && f.psnr >= p.psnr;
      EXPECT_TRUE(covered);
    }
  }
}

TEST(ParetoFront, LeavesLosslessPointsOut) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(paretoFront({{1, 30}, {2, infinity}}).size(), 1u);
}

TEST(UpperEnvelope, IsTheBetterCurveAtEveryRate) {
  // Two settings of which either wins on its side of 0.5 bits.
  Curve low, high;
  for (const RatePoint& p : codecCurve(1)) {
    low.push_back({p.rate, p.psnr - 0.4 * std::log2(p.rate / 0.5)});
    high.push_back({p.rate * 1.07, p.psnr + 0.4 * std::log2(p.rate / 0.5)});
  }
  const Curve envelope = upperEnvelope({low, high, {{1, 99}}});
  EXPECT_GT(envelope.size(), low.size());
  for (const Curve& curve : {low, high}) {
    const auto over = rateDifference(curve, envelope, {0.05, 2});
    ASSERT_TRUE(over.ok());
    EXPECT_LT(over->ratio, -0.005);
  }
  const RateWindow below{0.02, 0.2}, above{1, 3};
  EXPECT_NEAR(rateDifference(low, envelope, below)->ratio, 0, 1e-3);
  EXPECT_NEAR(rateDifference(high, envelope, above)->ratio, 0, 1e-3);
}

TEST(UpperEnvelope, OfOneCurveIsItsFront) {
  const Curve curve = codecCurve(1), envelope = upperEnvelope({curve});
  ASSERT_EQ(envelope.size(), curve.size());
  for (size_t i = 0; i < curve.size(); ++i) EXPECT_DOUBLE_EQ(envelope[i].psnr, curve[i].psnr);
}

TEST(RateDifference, FindsAConstantRatioExactly) {
  for (double factor : {0.5, 0.83, 1.0, 1.27, 2.0}) {
    const auto result = rateDifference(codecCurve(1), codecCurve(factor), {0.05, 2});
    ASSERT_TRUE(result.ok()) << result.status().message();
    EXPECT_NEAR(result->ratio, factor - 1, 1e-12);
  }
}

TEST(RateDifference, DoesNotDependOnWhereTheCurvesAreSampled) {
  Curve dense;
  for (int i = 0; i < 40; ++i) {
    const double rate = 0.015 * std::pow(1.2, i);
    dense.push_back({rate * 0.9, 20 + 9 * std::log2(1 + 8 * rate)});
  }
  const auto result = rateDifference(codecCurve(1), dense, {0.05, 2});
  ASSERT_TRUE(result.ok());
  EXPECT_NEAR(result->ratio, -0.1, 1e-3);
}

TEST(RateDifference, ExchangingTheCurvesInvertsTheRatio) {
  Curve other;
  for (const RatePoint& p : codecCurve(1)) other.push_back({p.rate, p.psnr + 0.3 + 0.1 * p.rate});
  const RateWindow everything{1e-9, 1e9};
  const auto forth = rateDifference(codecCurve(1), other, everything);
  const auto back = rateDifference(other, codecCurve(1), everything);
  ASSERT_TRUE(forth.ok() && back.ok());
  EXPECT_LT(forth->ratio, 0);
  EXPECT_NEAR((1 + forth->ratio) * (1 + back->ratio), 1, 1e-12);
}

TEST(RateDifference, CountsOnlyTheWindow) {
  Curve test = codecCurve(1);
  for (RatePoint& p : test) p.rate *= p.rate < 0.3 ? 0.8 : 1.1;
  const auto low = rateDifference(codecCurve(1), test, {0.02, 0.1});
  const auto high = rateDifference(codecCurve(1), test, {0.7, 3});
  ASSERT_TRUE(low.ok() && high.ok());
  EXPECT_NEAR(low->ratio, -0.2, 0.01);
  EXPECT_NEAR(high->ratio, 0.1, 0.01);
}

TEST(RateDifference, RefusesCurvesThatShareNoQuality) {
  Curve better = codecCurve(1);
  for (RatePoint& p : better) p.psnr += 200;
  EXPECT_EQ(rateDifference(codecCurve(1), better, {0.05, 2}).status().code(), TKS_USAGE);
  EXPECT_EQ(rateDifference({{1, 30}}, codecCurve(1), {0.05, 2}).status().code(), TKS_USAGE);
  EXPECT_EQ(rateDifference(codecCurve(1), {}, {0.05, 2}).status().code(), TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis::bench
