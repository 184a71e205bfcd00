// SPDX-License-Identifier: Apache-2.0
// Convex hulls, marginal allocation, the audit of rate points, and the screen model.
#include <gtest/gtest.h>

#include <cmath>

#include "conformance/samples/terrain_samples.hpp"
#include "ratecontrol/allocation.hpp"
#include "ratecontrol/audit.hpp"
#include "ratecontrol/hull.hpp"
#include "ratecontrol/screen_model.hpp"

namespace tetrakis {
namespace {

std::vector<RatePoint> bumpyCurve(uint64_t step, double scale) {
  std::vector<RatePoint> points;
  for (uint64_t i = 0; i < 60; ++i) {
    const double bump = i % 3 == 1 ? 1.15 : 1.0;
    points.push_back({i * step, scale * std::exp(-0.1 * static_cast<double>(i)) * bump});
  }
  points.back().distortion = 0;
  return points;
}

double slope(const RatePoint& a, const RatePoint& b) {
  return (a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes);
}

TEST(Hull, IsConvexAndBelowEveryPoint) {
  const std::vector<RatePoint> points = bumpyCurve(100, 5);
  const std::vector<RatePoint> hull = lowerHull(points, 0);
  ASSERT_GE(hull.size(), 3u);
  EXPECT_EQ(hull.front().bytes, points.front().bytes);
  EXPECT_EQ(hull.back().bytes, points.back().bytes);
  for (size_t i = 2; i < hull.size(); ++i)
    EXPECT_LE(slope(hull[i - 1], hull[i]), slope(hull[i - 2], hull[i - 1]));
  for (const RatePoint& point : points) {
    size_t i = 1;
    while (hull[i].bytes < point.bytes) ++i;
    const double chord = hull[i].distortion + slope(hull[i - 1], hull[i]) *
                                                  static_cast<double>(hull[i].bytes - point.bytes);
    EXPECT_GE(point.distortion, chord - 1e-9);
  }
}

TEST(Hull, KeepsPacketsApart) {
  const std::vector<RatePoint> hull = lowerHull(bumpyCurve(10, 5), 0.1);
  for (size_t i = 1; i + 1 < hull.size(); ++i) {
    EXPECT_GE(hull[i].bytes - hull[i - 1].bytes, kLeastPacket);
    EXPECT_GE(static_cast<double>(hull[i].bytes - hull[i - 1].bytes),
              0.1 * static_cast<double>(hull[i - 1].bytes) - 1);
  }
}

/// Whatever dips: packets cover the step once and in order, end at points, and where a point says
/// that bytes before it dip the packet over them does. Others are as few as can be.
TEST(PacketEnds, DipsHavePacketsOfTheirOwn) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::vector<RatePoint> points = bumpyCurve(1 + seed % 17, 5);
    for (size_t i = 1; i < points.size(); ++i)
      points[i].dips = samples::hash(static_cast<uint32_t>(i), seed, 1) % 7 == 0;
    const RatePoint &from = points[seed % 5], &to = points[points.size() - 1 - seed % 3];
    const std::vector<RatePoint> ends = packetEnds(points, from, to);
    ASSERT_FALSE(ends.empty());
    EXPECT_EQ(ends.back().bytes, to.bytes);
    uint64_t begin = from.bytes;
    bool before = true;
    for (const RatePoint& end : ends) {
      ASSERT_GT(end.bytes, begin);
      EXPECT_TRUE(before || end.dips) << "two packets that could be one";
      bool dips = false;
      for (const RatePoint& point : points)
        dips |= point.dips && point.bytes > begin && point.bytes <= end.bytes;
      EXPECT_EQ(end.dips, dips) << begin << " to " << end.bytes;
      if (!end.dips && end.bytes != to.bytes) {
        EXPECT_GE(end.bytes - begin, kLeastPacket);
      }
      begin = end.bytes;
      before = end.dips;
    }
  }
}

ComponentCurve curveOf(Component component, const std::vector<RatePoint>& points) {
  ComponentCurve curve{lowerHull(points, 0), {}};
  for (size_t i = 1; i < curve.points.size(); ++i) {
    curve.packets.push_back(
        {component, false, 0, curve.points[i - 1].bytes, curve.points[i].bytes, {}});
  }
  return curve;
}

/// Distortion left after the packets in `order` have used at most `budget` payload bytes, packets
/// being divisible.
double leftAfter(const std::array<ComponentCurve, kComponents>& curves, uint64_t first,
                 uint64_t second) {
  const auto at = [](const ComponentCurve& curve, uint64_t bytes) {
    size_t i = 1;
    while (i + 1 < curve.points.size() && curve.points[i].bytes < bytes) ++i;
    const RatePoint &a = curve.points[i - 1], &b = curve.points[i];
    return a.distortion - slope(a, b) * static_cast<double>(std::min(bytes, b.bytes) - a.bytes);
  };
  return at(curves[0], first) + at(curves[1], second);
}

TEST(Allocation, NoSplitOfAnyPrefixIsBetter) {
  const std::array<ComponentCurve, kComponents> curves = {
      curveOf(Component::kGeometry, bumpyCurve(70, 9)),
      curveOf(Component::kTexture, bumpyCurve(130, 40))};
  std::array<uint64_t, kComponents> sent = {};
  for (const Packet& packet : allocate(curves)) {
    const auto component = static_cast<size_t>(packet.component);
    ASSERT_EQ(packet.begin, sent[component]);
    sent[component] = packet.end;
    const uint64_t total = sent[0] + sent[1];
    const double ours = leftAfter(curves, sent[0], sent[1]);
    for (uint64_t first = 0; first <= std::min<uint64_t>(total, curves[0].points.back().bytes);
         first += 10) {
      if (total - first > curves[1].points.back().bytes) continue;
      EXPECT_LE(ours, leftAfter(curves, first, total - first) + 1e-9);
    }
  }
  EXPECT_EQ(sent[0], curves[0].points.back().bytes);
  EXPECT_EQ(sent[1], curves[1].points.back().bytes);
}

TEST(JoinNeighbours, KeepsBytesQualityStepsAndWholePackets) {
  const auto packet = [](Component component, bool whole, int quality, uint64_t begin,
                         uint64_t end) {
    return Packet{component, whole, static_cast<uint8_t>(quality), begin, end, {}};
  };
  const Component g = Component::kGeometry, t = Component::kTexture;
  const std::vector<Packet> packets = {
      packet(g, false, 90, 0, 10),   packet(t, false, 99, 0, 20),   // the first of each
      packet(t, false, 98, 20, 30),  packet(t, false, 97, 30, 50),  // two steps: one packet
      packet(t, false, 96, 50, 60),  packet(g, false, 90, 10, 20),  // the other track ends it
      packet(t, true, 96, 60, 70),   packet(t, false, 96, 70, 80),  // whole: by itself
      packet(t, false, 93, 80, 100),                                // three steps are too many
      packet(g, false, 89, 20, 30),  packet(g, false, 88, 30, 50)};
  const std::vector<Packet> joined = joinNeighbours(packets);
  const std::vector<std::pair<uint64_t, int>> expected = {
      {10, 90}, {20, 99}, {50, 97}, {60, 96}, {20, 90}, {70, 96}, {80, 96}, {100, 93}, {50, 88}};
  ASSERT_EQ(joined.size(), expected.size());
  std::array<uint64_t, kComponents> sent = {};
  for (size_t i = 0; i < joined.size(); ++i) {
    EXPECT_EQ(joined[i].end, expected[i].first);
    EXPECT_EQ(joined[i].quality, expected[i].second);
    EXPECT_EQ(joined[i].whole, i == 5);
    uint64_t& begin = sent[static_cast<size_t>(joined[i].component)];
    EXPECT_EQ(joined[i].begin, begin);
    begin = joined[i].end;
  }
}

TEST(JoinNeighbours, TracksOfRegionsStayApart) {
  std::vector<Packet> packets(4);
  for (uint32_t i = 0; i < 4; ++i) packets[i] = {Component::kTexture, false, 80, 0, 9, i / 2};
  packets[1].begin = packets[3].begin = 9;
  packets[1].end = packets[3].end = 18;
  const std::vector<Packet> joined = joinNeighbours(packets);
  ASSERT_EQ(joined.size(), 3u);  // the first packet of a component states its quality early
  EXPECT_EQ(joined[1].track, 0u);
  EXPECT_EQ(joined[2].track, 1u);
  EXPECT_EQ(joined[2].end, 18u);
}

TEST(Audit, TinyTracksGetAPointForEveryRecord) {
  EncodedTrack track;
  track.codeword.resize(9);
  track.points = {{0, 100}, {9, 0}};
  const std::vector<double> truth = {100, 90, 95, 80, 80, 50, 50.1, 40, 10, 0};
  const auto points = audit(track, {4}, [&](uint64_t bytes) { return truth[bytes]; });
  std::vector<uint64_t> bytes;
  for (const RatePoint& p : points) bytes.push_back(p.bytes);
  EXPECT_EQ(bytes, (std::vector<uint64_t>{0, 1, 3, 5, 7, 8, 9}));
  EXPECT_TRUE(points[2].dips);   // 95 after 90
  EXPECT_FALSE(points[4].dips);  // 50.1 after 50 is too little to see
}

TEST(Audit, LargeTracksAreCorrectedOnlyWithoutABudget) {
  EncodedTrack track;
  track.codeword.resize(5900);
  track.points = bumpyCurve(100, 1000);
  const auto twice = [&](uint64_t bytes) { return 2 * track.points[bytes / 100].distortion; };
  EXPECT_DOUBLE_EQ(audit(track, {1 << 20, 9000}, twice).front().distortion, 1000);
  EXPECT_NEAR(audit(track, {1 << 20}, twice).front().distortion, 2000, 1e-6);
}

Texels stripes(uint32_t period) {
  Texels texels{64, 64, 1, 8, std::vector<uint16_t>(64 * 64)};
  for (uint32_t i = 0; i < 64 * 64; ++i)
    texels.samples[i] = (i % 64) / (period / 2) % 2 == 0 ? 60 : 180;
  return texels;
}

TEST(ScreenModel, CostRisesAndSaturates) {
  const ScreenModel model(stripes(16), 0.5);
  EXPECT_EQ(model.cost(0), 0);
  double before = 0, rise = 1e300;
  for (double mse = 1; mse < 1e7; mse *= 2) {
    const double cost = model.cost(mse);
    EXPECT_GE(cost, before);
    EXPECT_LE((cost - before) / mse, rise);  // concave
    rise = (cost - before) / mse;
    before = cost;
  }
  EXPECT_NEAR(before, 2 * 60 * 60, 2 * 60 * 60 * 0.1);  // twice the variance of the stripes
}

TEST(ScreenModel, FollowsParallaxAndTexture) {
  EXPECT_GT(ScreenModel(stripes(16), 1.0).cost(1), ScreenModel(stripes(16), 0.5).cost(1));
  EXPECT_GT(ScreenModel(stripes(8), 0.5).cost(1), ScreenModel(stripes(32), 0.5).cost(1));
  Texels flat = stripes(16);
  std::fill(flat.samples.begin(), flat.samples.end(), 90);
  EXPECT_EQ(ScreenModel(flat, 1.0).cost(1e6), 0);
}

}  // namespace
}  // namespace tetrakis
