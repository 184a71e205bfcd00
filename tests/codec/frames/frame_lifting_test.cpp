// SPDX-License-Identifier: Apache-2.0
// Lifting over time is undone exactly, whatever the values, the scales and the number of frames;
// its norms are those of what it makes.
#include "codec/frames/frame_lifting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace tetrakis::test {
namespace {

using Frames = std::vector<std::vector<int32_t>>;

constexpr TimeFilter kFilters[] = {TimeFilter::kNone, TimeFilter::kHaar, TimeFilter::kFiveThree};

FrameViews viewsOf(Frames& frames) {
  return {frames.begin(), frames.end()};
}

FramesHeader headerOf(TimeFilter filter, size_t frames) {
  FramesHeader header;
  header.count = static_cast<uint8_t>(frames);
  header.filter = filter;
  return header;
}

Frames randomFrames(size_t count, int32_t low, int32_t high, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int32_t> value(low, high);
  Frames frames(count, std::vector<int32_t>(50));
  for (auto& frame : frames)
    for (int32_t& sample : frame) sample = value(random);
  return frames;
}

TEST(FrameLifting, IsUndoneForEveryNumberOfFrames) {
  for (const TimeFilter filter : kFilters) {
    for (size_t count = 2; count <= FramesHeader::kMost; ++count) {
      for (const int32_t most : {1000, std::numeric_limits<int32_t>::max()}) {
        const Frames truth = randomFrames(count, -most, most, 3);
        Frames frames = truth;
        const FramesHeader header = headerOf(filter, count);
        forwardFrames(header, 0, viewsOf(frames));
        EXPECT_EQ(frames == truth, filter == TimeFilter::kNone);
        inverseFrames(header, 0, viewsOf(frames));
        EXPECT_EQ(frames, truth) << count << " frames";
      }
    }
  }
}

TEST(FrameLifting, IsUndoneBesideScales) {
  std::mt19937 random(5);
  for (const TimeFilter filter : kFilters) {
    for (size_t count = 2; count <= 9; ++count) {
      FramesHeader header = headerOf(filter, count);
      for (size_t t = 0; t < count; ++t)
        header.scales.push_back(
            {static_cast<int64_t>(random() % 4000) - 2000, static_cast<uint8_t>(random() % 7)});
      for (const int fraction_bits : {0, 4}) {
        const Frames truth = randomFrames(count, -5000, 5000, 7);
        Frames frames = truth;
        forwardFrames(header, fraction_bits, viewsOf(frames));
        inverseFrames(header, fraction_bits, viewsOf(frames));
        EXPECT_EQ(frames, truth);
      }
    }
  }
}

TEST(FrameLifting, LeavesNothingOfWhatStandsStill) {
  const Frames first = randomFrames(1, -30000, 30000, 9);
  for (const TimeFilter filter : {TimeFilter::kHaar, TimeFilter::kFiveThree}) {
    Frames frames(13, first[0]);
    forwardFrames(headerOf(filter, frames.size()), 0, viewsOf(frames));
    EXPECT_EQ(frames[0], first[0]);
    for (size_t t = 1; t < frames.size(); ++t)
      EXPECT_EQ(frames[t], std::vector<int32_t>(50)) << "frame " << t;
  }
}

/// Of 32 frames, in whose middle signals have no ends, about.
TEST(FrameLifting, NormsAreThoseOfItsFunctions) {
  constexpr int32_t kUnit = 1 << 20;
  for (const TimeFilter filter : {TimeFilter::kHaar, TimeFilter::kFiveThree}) {
    const FramesHeader header = headerOf(filter, 32);
    const FrameNorms norms(header);
    for (const uint32_t plane : {15u, 14u, 12u}) {
      Frames frames(32, std::vector<int32_t>(1));
      frames[plane][0] = kUnit;
      inverseFrames(header, 0, viewsOf(frames));
      double squares = 0;
      for (const auto& frame : frames) squares += std::pow(double{1} * frame[0] / kUnit, 2);
      EXPECT_NEAR(norms.energy(plane), squares, 0.01 * squares) << plane;
      EXPECT_NEAR(norms.log16(plane), 8 * std::log2(squares), 0.6) << plane;
    }
  }
}

TEST(FrameLifting, EachFrameLiesInTheTimeOfTheCoarserOne) {
  for (uint32_t count = 1; count <= FramesHeader::kMost; ++count) {
    EXPECT_EQ(coarserFrame(0, count), 0u);
    for (uint32_t t = 1; t < count; ++t) {
      const uint32_t own = t & (0u - t), coarser = coarserFrame(t, count);
      if (coarser == t) continue;
      EXPECT_LT(coarser, count);
      EXPECT_EQ(coarser & (0u - coarser), 2 * own);
      EXPECT_EQ(std::abs(static_cast<int>(coarser) - static_cast<int>(t)), static_cast<int>(own));
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
