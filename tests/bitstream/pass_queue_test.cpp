// SPDX-License-Identifier: Apache-2.0
// The order of passes by its properties.
#include "bitstream/track/track.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace tetrakis {

std::ostream& operator<<(std::ostream& out, PassKind kind) {
  constexpr const char* kNames[] = {"likely", "rest", "refine"};
  return out << kNames[static_cast<size_t>(kind)];
}

namespace {

using Random = std::mt19937;

std::vector<BandPlan> randomPlan(Random& random) {
  std::vector<BandPlan> plan(1 + random() % 8);
  for (BandPlan& band : plan) {
    band.shape = {static_cast<uint32_t>(random() % 40), static_cast<uint32_t>(random() % 70)};
    band.log_norm = static_cast<int>(random() % 200) - 50;
    band.needed = random() % 4 != 0;
  }
  return plan;
}

/// A band of which so many coefficients, from the first on, are significant.
Band bandWith(const BandShape& shape, uint32_t significant) {
  Band band(shape, Orientation::kHL);
  band.tier_states[0].nonzero = significant > 0;
  band.tier_states[0].significant_count = significant;
  return band;
}

TEST(PassQueue, HoldsEveryPassOnceAndPlanesOfABandInTurn) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<BandPlan> plan = randomPlan(random);
    const int planes = static_cast<int>(random() % 12);
    std::vector<uint32_t> significant(plan.size(), 0);
    std::map<uint32_t, std::set<std::tuple<int, PassKind>>> seen;
    PassQueue queue(plan, planes);
    size_t count = 0, wanted = 0, left = 0;
    for (const BandPlan& band : plan) {
      wanted += band.shape.empty() ? 0 : 3 * static_cast<size_t>(planes);
      left += band.shape.empty() || !band.needed ? 0 : 3 * static_cast<size_t>(planes);
    }
    for (; !queue.empty(); ++count) {
      EXPECT_EQ(queue.needed(), left > 0);
      const Pass pass = queue.front();
      auto& of_band = seen[pass.band];
      EXPECT_TRUE(of_band.insert({pass.plane, pass.kind}).second);
      const bool starts = pass.kind == PassKind::kLikely;
      EXPECT_EQ(of_band.count({pass.plane, PassKind::kLikely}), 1u);
      EXPECT_EQ(of_band.size(), 3u * static_cast<size_t>(planes - 1 - pass.plane) +
                                    (starts                    ? 1
                                     : of_band.size() % 3 == 0 ? 3
                                                               : 2));
      const BandShape& shape = plan[pass.band].shape;
      uint32_t& known = significant[pass.band];
      if (pass.kind != PassKind::kRefine) known += (shape.rows * shape.columns - known) / 3;
      queue.pop(bandWith(shape, known));
      left -= plan[pass.band].needed;
    }
    EXPECT_EQ(count, wanted);
  }
}

/// Each pass is behind the one before, also where floors make keys alike.
TEST(PassQueue, GivesPassesInTheOrderOfTheirRanks) {
  Random random(2);
  const auto rankOf = [](const Pass& pass) {
    return std::tuple(-pass.key, -pass.plane, pass.band, -pass.tier, pass.kind);
  };
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<BandPlan> plan(500, BandPlan{.shape = {3, 5}});
    for (BandPlan& band : plan) {
      band.log_norm = static_cast<int>(random() % 60);
      if (trial % 2 != 0) band.key_floor = static_cast<int>(random() % 3);
    }
    std::vector<uint32_t> significant(plan.size(), 0);
    PassQueue queue(plan, 5);
    std::tuple before = rankOf({0, 0, 0, PassKind::kLikely, 1 << 20});
    size_t count = 0;
    for (; !queue.empty(); ++count) {
      const Pass pass = queue.front();
      EXPECT_LT(before, rankOf(pass));
      before = rankOf(pass);
      uint32_t& known = significant[pass.band];
      if (random() % 4 == 0) known = std::min(known + 5, 15u);
      queue.pop(bandWith(plan[pass.band].shape, known));
    }
    EXPECT_EQ(count, 5 * 3 * plan.size());
  }
}

/// Of two bands with as many significant coefficients, one whose norm is twice as large is a plane
/// ahead.
TEST(PassQueue, FollowsTheNorms) {
  std::vector<BandPlan> plan(2);
  plan[0].shape = plan[1].shape = {10, 10};
  plan[1].log_norm = 16;
  PassQueue queue(plan, 8);
  for (int i = 0; !queue.empty(); ++i) {
    const Pass pass = queue.front();
    if (i < 3) {
      EXPECT_EQ(pass.band, 1u);
    }
    queue.pop(bandWith(plan[0].shape, 50));
  }
}

/// Of two bands alike, the rest of the one with more significant coefficients comes first.
TEST(PassQueue, LooksFirstWhereMuchIsSignificant) {
  for (const uint32_t dense : {0u, 1u}) {
    std::vector<BandPlan> plan(2);
    plan[0].shape = plan[1].shape = {100, 100};
    PassQueue queue(plan, 2);
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(queue.front().kind, PassKind::kLikely);
      queue.pop(bandWith(plan[0].shape, queue.front().band == dense ? 5000 : 5));
    }
    EXPECT_EQ(queue.front().kind, PassKind::kRest);
    EXPECT_EQ(queue.front().band, dense);
  }
}

}  // namespace
}  // namespace tetrakis
