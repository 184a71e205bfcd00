// SPDX-License-Identifier: Apache-2.0
// Polylines against all subsets of their knots, and against one another (thesis chapter 2).
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "codec/polyline/polylines.hpp"
#include "tests/support/polyline_curves.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kSizes[] = {2, 3, 4, 5, 8, 9, 12, 13, 17, 30, 65, 100};

/// Sums of squares of so large heights are off by about this.
double tolerance(const Curve& curve) {
  return 1e-9 * (1 + curve.error(0, curve.size() - 1));
}

/// The definition (2.1), knot by knot.
double slowError(const std::vector<double>& places, const std::vector<double>& heights, uint32_t a,
                 uint32_t b) {
  double sum = 0;
  for (uint32_t k = a + 1; k < b; ++k) {
    const double part = (places[k] - places[a]) / (places[b] - places[a]);
    const double off = heights[k] - heights[a] - part * (heights[b] - heights[a]);
    sum += off * off;
  }
  return sum;
}

/// The least error of all subsets of so many knots, by number of segments.
std::vector<double> bestOfAllSubsets(const Curve& curve) {
  const uint32_t inner = curve.size() - 2;
  std::vector<double> best(curve.size(), std::numeric_limits<double>::infinity());
  for (uint32_t subset = 0; subset < (1U << inner); ++subset) {
    std::vector<uint32_t> knots{0};
    for (uint32_t k = 0; k < inner; ++k)
      if ((subset >> k & 1) != 0) knots.push_back(k + 1);
    knots.push_back(curve.size() - 1);
    double& least = best[knots.size() - 1];
    least = std::min(least, errorOf(curve, knots));
  }
  return best;
}

TEST(Curve, ErrorsOfChordsAreTheirSums) {
  for (const uint32_t size : kSizes)
    for (const NamedCurve& named : namedCurves(size, size)) {
      std::vector<double> places;
      for (uint32_t k = 0; k < size; ++k) places.push_back(2000 + 3.0 * k + (k % 5) * 0.5);
      const Curve curve(places, named.heights);
      for (uint32_t a = 0; a < size; ++a)
        for (uint32_t b = a + 1; b < size; ++b) {
          const double slow = slowError(places, named.heights, a, b);
          EXPECT_NEAR(curve.error(a, b), slow, tolerance(curve)) << named.name << a << ' ' << b;
          for (uint32_t k = a + 1; k < b; ++k) {
            const double gain = slow - slowError(places, named.heights, a, k) -
                                slowError(places, named.heights, k, b);
            EXPECT_NEAR(curve.gain(a, k, b), gain, tolerance(curve));
          }
          if (b == a + 2) {
            EXPECT_NEAR(curve.deviation(a, a + 1, b), slow, tolerance(curve));
          }
        }
    }
}

TEST(Polylines, StateTheErrorsOfTheirKnots) {
  for (const uint32_t size : kSizes)
    for (const NamedCurve& named : namedCurves(size, size)) {
      const Curve curve(named.heights);
      for (const Algorithm& algorithm : kAlgorithms) {
        SCOPED_TRACE(std::string(algorithm.name) + ' ' + named.name + ' ' + std::to_string(size));
        const Polylines polylines = algorithm.run(curve);
        ASSERT_EQ(polylines.errors.size(), size);
        EXPECT_FALSE(polylines.has(0));
        EXPECT_TRUE(polylines.has(1));
        EXPECT_TRUE(polylines.has(size - 1));
        EXPECT_NEAR(polylines.errors[size - 1], 0, tolerance(curve));
        for (uint32_t c = 1; c < size; ++c) {
          if (algorithm.run != coptimal) {
            EXPECT_TRUE(polylines.has(c));
          }
          if (!polylines.has(c)) continue;
          EXPECT_EQ(polylines.reached(c), c);
          const std::vector<uint32_t> knots = polylines.knots(c);
          ASSERT_EQ(knots.size(), c + 1);
          EXPECT_EQ(knots.front(), 0U);
          EXPECT_EQ(knots.back(), size - 1);
          EXPECT_TRUE(std::is_sorted(knots.begin(), knots.end(), std::less_equal<>()));
          EXPECT_NEAR(polylines.errors[c], errorOf(curve, knots), tolerance(curve));
        }
      }
    }
}

TEST(Polylines, OfUoptimalAreTheBestOfAllSubsets) {
  for (uint32_t size = 2; size <= 13; ++size)
    for (const NamedCurve& named : namedCurves(size, 7 * size)) {
      const Curve curve(named.heights);
      const std::vector<double> best = bestOfAllSubsets(curve);
      const Polylines optimal = uoptimal(curve);
      for (uint32_t c = 1; c < size; ++c)
        EXPECT_NEAR(optimal.errors[c], best[c], tolerance(curve)) << named.name << size << ' ' << c;
    }
}

TEST(Polylines, OfUoptimalDoNotDependOnHowManyAreAskedFor) {
  for (const NamedCurve& named : namedCurves(40, 3)) {
    const Curve curve(named.heights);
    const Polylines all = uoptimal(curve), some = uoptimalUpTo(curve, 9);
    EXPECT_TRUE(some.has(9));
    EXPECT_FALSE(some.has(10));
    for (uint32_t c = 1; c <= 9; ++c) {
      EXPECT_EQ(some.errors[c], all.errors[c]);
      EXPECT_EQ(some.knots(c), all.knots(c));
    }
    EXPECT_EQ(uoptimalUpTo(curve, 1000).before, all.before);
  }
}

TEST(Polylines, OfOtherAlgorithmsAreNeverBetterThanOptimalOnes) {
  for (const uint32_t size : kSizes)
    for (const NamedCurve& named : namedCurves(size, 11 * size)) {
      const Curve curve(named.heights);
      const Polylines optimal = uoptimal(curve);
      for (const Algorithm& algorithm : kAlgorithms) {
        const Polylines polylines = algorithm.run(curve);
        for (uint32_t c = 1; c < size; ++c) {
          if (!polylines.has(c)) continue;
          EXPECT_GE(polylines.errors[c], optimal.errors[c] - tolerance(curve))
              << algorithm.name << ' ' << named.name << ' ' << size << ' ' << c;
        }
      }
    }
}

TEST(Polylines, AreNestedWhereTable23SaysSo) {
  for (const NamedCurve& named : namedCurves(65, 5)) {
    const Curve curve(named.heights);
    for (const Algorithm& algorithm : kAlgorithms) {
      if (!algorithm.nested) continue;
      const Polylines polylines = algorithm.run(curve);
      std::vector<uint32_t> coarser = polylines.knots(1);
      for (uint32_t c = 2; c < curve.size(); ++c) {
        if (!polylines.has(c)) continue;
        std::vector<uint32_t> finer = polylines.knots(c);
        EXPECT_TRUE(std::includes(finer.begin(), finer.end(), coarser.begin(), coarser.end()))
            << algorithm.name << ' ' << named.name << ' ' << c;
        coarser = std::move(finer);
      }
    }
  }
}

/// Each step of the greedy ones is the best that there is, judged by the definitions.
TEST(Polylines, OfGreedyAlgorithmsTakeTheBestStep) {
  for (const NamedCurve& named : namedCurves(33, 21)) {
    const Curve curve(named.heights);
    const Polylines refined = urefine(curve), decimated = udecimate(curve),
                    global = udecimateGlobal(curve);
    for (uint32_t c = 1; c + 1 < curve.size(); ++c) {
      const std::vector<uint32_t> coarse = refined.knots(c);
      double farthest = 0, taken = -1;
      for (size_t i = 1; i < coarse.size(); ++i)
        for (uint32_t k = coarse[i - 1] + 1; k < coarse[i]; ++k) {
          const double distance = curve.deviation(coarse[i - 1], k, coarse[i]);
          farthest = std::max(farthest, distance);
          if (refined.entry[k] == c + 1) taken = distance;
        }
      EXPECT_EQ(taken, farthest) << named.name << ' ' << c;
      const std::vector<uint32_t> fine = decimated.knots(c + 1), whole = global.knots(c + 1);
      double nearest = std::numeric_limits<double>::infinity(), least = nearest, gone = -1,
             paid = -1;
      for (size_t i = 1; i + 1 < fine.size(); ++i) {
        const double distance = curve.deviation(fine[i - 1], fine[i], fine[i + 1]);
        nearest = std::min(nearest, distance);
        if (decimated.entry[fine[i]] == c + 1) gone = distance;
        const double gain = curve.gain(whole[i - 1], whole[i], whole[i + 1]);
        least = std::min(least, gain);
        if (global.entry[whole[i]] == c + 1) paid = gain;
      }
      EXPECT_EQ(gone, nearest) << named.name << ' ' << c;
      EXPECT_EQ(paid, least) << named.name << ' ' << c;
    }
  }
}

/// Table 2.1 says 8 for two segments, which every greedy algorithm of the thesis reaches; the
/// optimum is 68/9, and decimation by global error finds it. One segment is better either way
/// (2.2.3).
TEST(Polylines, OfTable21) {
  const Curve curve(zigzag());
  for (const Algorithm& algorithm : kAlgorithms) {
    if (algorithm.run == coptimal) continue;
    SCOPED_TRACE(algorithm.name);
    const Polylines polylines = algorithm.run(curve);
    EXPECT_NEAR(polylines.errors[4], 0, 1e-12);
    EXPECT_NEAR(polylines.errors[3], 4, 1e-12);
    const bool finds_best = algorithm.run == uoptimal || algorithm.run == udecimateGlobal;
    EXPECT_NEAR(polylines.errors[2], finds_best ? 68.0 / 9 : 8, 1e-12);
    EXPECT_NEAR(polylines.errors[1], 6, 1e-12);
  }
}

TEST(Polylines, OfStraightLinesHaveNoErrors) {
  const Curve curve(namedCurves(65, 1)[3].heights);
  for (const Algorithm& algorithm : kAlgorithms) {
    const Polylines polylines = algorithm.run(curve);
    EXPECT_NEAR(polylines.errors[1], 0, 1e-9) << algorithm.name;
  }
}

}  // namespace
}  // namespace tetrakis::test
