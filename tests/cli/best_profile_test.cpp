// SPDX-License-Identifier: Apache-2.0
// How the pieces of a line share the points of a profile.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "apps/tools/profile/best_profile.hpp"
#include "codec/polyline/polylines.hpp"

namespace tetrakis::test {
namespace {

using tools::BestProfile;
using tools::GroundLine;

GroundLine walks(const std::vector<uint32_t>& sizes, uint32_t seed) {
  std::minstd_rand random(seed);
  GroundLine line;
  double distance = 0, height = 0;
  for (const uint32_t size : sizes) {
    line.pieces.emplace_back();
    for (uint32_t k = 0; k < size; ++k) {
      height += static_cast<double>(random() % 21) - 10;
      line.pieces.back().push_back({distance += 3 + (k % 2), height, {}});
    }
  }
  line.length = distance;
  return line;
}

Curve curveOf(const std::vector<tools::GroundSample>& piece) {
  std::vector<double> distances, heights;
  for (const tools::GroundSample& sample : piece) {
    distances.push_back(sample.distance);
    heights.push_back(sample.height);
  }
  return {distances, heights};
}

/// Its points are samples, with both ends of each piece; its error is theirs.
void expectSound(const GroundLine& line, const BestProfile& profile, size_t points) {
  ASSERT_EQ(profile.points.size(), line.pieces.size());
  size_t count = 0;
  double error = 0;
  for (size_t p = 0; p < line.pieces.size(); ++p) {
    const std::vector<uint32_t>& kept = profile.points[p];
    count += kept.size();
    ASSERT_FALSE(kept.empty());
    EXPECT_EQ(kept.front(), 0U);
    EXPECT_EQ(kept.back(), line.pieces[p].size() - 1);
    if (kept.size() > 1) error += errorOf(curveOf(line.pieces[p]), kept);
  }
  EXPECT_LE(count, points);
  EXPECT_NEAR(profile.rmse, std::sqrt(error / static_cast<double>(line.samples())), 1e-6);
}

/// Against every way to share the points.
TEST(BestProfile, SharesPointsAmongPiecesForTheLeastError) {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    const GroundLine line = walks({9, 1, 2, 12, 5}, seed);
    std::vector<Polylines> best;
    for (const size_t p : {0, 3, 4}) best.push_back(uoptimal(curveOf(line.pieces[p])));
    for (size_t points = fewestPoints(line); points <= line.samples() + 1; ++points) {
      double least = std::numeric_limits<double>::infinity();
      for (uint32_t a = 1; a <= 8; ++a)
        for (uint32_t b = 1; b <= 11; ++b)
          for (uint32_t c = 1; c <= 4; ++c)
            if (a + b + c + 3 + 3 <= points)
              least = std::min(least, best[0].errors[a] + best[1].errors[b] + best[2].errors[c]);
      const BestProfile profile = bestProfile(line, points);
      expectSound(line, profile, points);
      EXPECT_STREQ(profile.algorithm, "uoptimal");
      EXPECT_NEAR(profile.rmse, std::sqrt(least / static_cast<double>(line.samples())), 1e-6);
    }
  }
}

TEST(BestProfile, TakesNoMorePointsThanTheErrorNeeds) {
  GroundLine line = walks({50}, 1);
  for (tools::GroundSample& sample : line.pieces[0]) sample.height = 700 + sample.distance / 3;
  const BestProfile profile = bestProfile(line, 40);
  EXPECT_EQ(profile.points[0].size(), 2U);
  EXPECT_NEAR(profile.rmse, 0, 1e-4);
}

/// Too long for dynamic programming: many pieces, and one piece.
TEST(BestProfile, DecimatesLongLines) {
  for (const std::vector<uint32_t>& sizes :
       {std::vector<uint32_t>{40000}, std::vector<uint32_t>(9000, 3),
        std::vector<uint32_t>{30000, 1, 2, 9000}}) {
    const GroundLine line = walks(sizes, 4);
    double before = std::numeric_limits<double>::infinity();
    for (const size_t points : {fewestPoints(line) + 1000, line.samples() - 200, line.samples()}) {
      const BestProfile profile = bestProfile(line, points);
      expectSound(line, profile, points);
      EXPECT_LE(profile.rmse, before + 1e-6);
      before = profile.rmse;
    }
    EXPECT_NEAR(before, 0, 1e-6);
    EXPECT_STREQ(bestProfile(line, fewestPoints(line) + 1000).algorithm, "udecimate-global");
  }
}

}  // namespace
}  // namespace tetrakis::test
