// SPDX-License-Identifier: Apache-2.0
// Counted operations against the costs of thesis 2.3 to 2.7 (table 2.3).
#include <gtest/gtest.h>

#include <cmath>

#include "codec/polyline/polylines.hpp"
#include "tests/support/polyline_curves.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kDyadicSizes[] = {17, 33, 65, 129, 257, 513, 1025, 2049};

double total(const Polylines& polylines) {
  return static_cast<double>(polylines.operations.total());
}

/// m log2 m of so many knots.
double sortingCost(uint32_t knots) {
  const double m = knots - 2;
  return m * std::log2(m);
}

/// Walks are what the means of the thesis are about: curves like terrain. Beside the leading term
/// there are at most 1.5 m operations, those of (2.34) and (2.35).
TEST(PolylineCosts, OfWalksAreThoseOfTable23) {
  for (const uint32_t size : kDyadicSizes) {
    constexpr uint32_t kWalks = 12;
    std::vector<double> operations(kAlgorithms.size(), 0);
    for (uint32_t seed = 1; seed <= kWalks; ++seed) {
      const Curve curve(namedCurves(size, size + seed).front().heights);
      for (size_t i = 0; i < kAlgorithms.size(); ++i)
        if (kAlgorithms[i].factor > 0) operations[i] += total(kAlgorithms[i].run(curve)) / kWalks;
    }
    for (size_t i = 0; i < kAlgorithms.size(); ++i)
      EXPECT_LE(operations[i], kAlgorithms[i].factor * sortingCost(size) + 1.5 * size)
          << kAlgorithms[i].name << ' ' << size;
  }
}

/// Nothing but urefine has a worse case. A search among j knots takes log2 j comparisons in the
/// thesis; in the trees of a std::multiset it may take twice as many, which the algorithms of one
/// m log m feel.
TEST(PolylineCosts, OfAnyCurvesHaveTheirOrder) {
  for (const uint32_t size : kDyadicSizes)
    for (const NamedCurve& named : namedCurves(size, size)) {
      const Curve curve(named.heights);
      for (const Algorithm& algorithm : kAlgorithms) {
        const double most = algorithm.factor == 1 ? 2 : algorithm.factor;
        if (algorithm.factor == 0 || algorithm.run == urefine) continue;
        EXPECT_LE(total(algorithm.run(curve)), most * sortingCost(size))
            << algorithm.name << ' ' << named.name << ' ' << size;
      }
    }
}

/// (2.23) and the list. Straight lines, where every knot is as far as all others, are the worst.
TEST(PolylineCosts, OfUrefineAreAtMostSquare) {
  for (const uint32_t size : kDyadicSizes)
    for (const NamedCurve& named : namedCurves(size, size)) {
      const double m = size - 2;
      EXPECT_LE(total(urefine(Curve(named.heights))), m * m + m + 2 * sortingCost(size))
          << named.name << ' ' << size;
    }
}

/// (2.17) counts an error knot by knot; prefix sums make it one operation: n^3 / 3, not n^3 / 2.
TEST(PolylineCosts, OfUoptimalAreCubic) {
  for (const uint32_t size : {17U, 65U, 257U}) {
    const double n = size;
    const Polylines optimal = uoptimal(Curve(namedCurves(size, size).front().heights));
    EXPECT_LE(total(optimal), n * n * n / 2 - 3 * n * n / 2 + n);
    EXPECT_NEAR(total(optimal) / (n * n * n), 1.0 / 3, 1 / n);
    EXPECT_EQ(optimal.operations.errors, static_cast<uint64_t>(size) * (size - 1) / 2);
  }
}

}  // namespace
}  // namespace tetrakis::test
