// SPDX-License-Identifier: Apache-2.0
// What the bytes of one component are worth: hulls, ends of packets, the audit, whole curves.
#include <gtest/gtest.h>

#include "conformance/samples/terrain_samples.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "ratecontrol/needs/needs.hpp"
#include "tests/support/rate_curves.hpp"

namespace tetrakis {
namespace {

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

/// Noise takes more bytes than a small track can afford to measure one by one.
TEST(Audit, SmallTracksDecodeABoundedNumberOfSamples) {
  for (const uint64_t samples : {uint64_t{4000}, kSmallSamples}) {
    EncodedTrack track;
    track.codeword.resize(40000);
    for (uint64_t i = 0; i <= 1000; ++i)
      track.points.push_back({40 * i, static_cast<double>(1001 - i)});
    uint64_t measured = 0;
    const auto points = audit(track, {samples}, [&](uint64_t bytes) {
      ++measured;
      return 1001 - static_cast<double>(bytes) / 40;
    });
    EXPECT_LE(measured * samples, (uint64_t{1} << 23) + 2 * samples * track.points.size());
    EXPECT_EQ(points[1].bytes, 1u) << "the first bytes are measured one by one";
  }
}

TEST(Audit, LargeTracksAreCorrectedOnlyWithoutABudget) {
  EncodedTrack track;
  track.codeword.resize(5900);
  track.points = bumpyCurve(100, 1000);
  const auto twice = [&](uint64_t bytes) { return 2 * track.points[bytes / 100].distortion; };
  EXPECT_DOUBLE_EQ(audit(track, {1 << 20, 9000}, twice).front().distortion, 1000);
  EXPECT_NEAR(audit(track, {1 << 20}, twice).front().distortion, 2000, 1e-6);
}

/// Tracks whose error halves with every ten bytes; the first has an opening that seems worth
/// little.
std::vector<EncodedTrack> tracksWithOpening(size_t count, uint64_t opening) {
  std::vector<EncodedTrack> tracks(count);
  for (size_t i = 0; i < count; ++i) {
    double distortion = 1e6 * static_cast<double>(i + 1);
    uint64_t bytes = i == 0 ? opening : 0;
    if (bytes > 0) tracks[i].points.push_back({0, distortion + 1});
    for (; distortion > 1; distortion /= 2, bytes += 10)
      tracks[i].points.push_back({bytes, distortion});
    tracks[i].codeword.resize(tracks[i].points.back().bytes);
  }
  return tracks;
}

/// Packets lead from nothing to all of every track, the opening first, and every prefix that
/// decoders get is made of them.
TEST(ComponentCurve, PacketsCoverTheTracksAndTheOpeningComesFirst) {
  for (const size_t count : {size_t{1}, size_t{3}}) {
    const std::vector<EncodedTrack> tracks = tracksWithOpening(count, 50);
    const CodedTracks coded{Component::kTexture, tracks, 50};
    const auto measure = [](const std::vector<Packet>&, uint64_t) { return 1.0; };
    const Pricing pricing{100};
    const ComponentCurve curve = curveOf(coded, {1 << 20, 9000}, measure, pricing);
    ASSERT_GE(curve.packets.size(), 2u);
    EXPECT_EQ(curve.points[1].bytes, 50u) << "worth the most of all";
    EXPECT_EQ(curve.packets.front().end, 50u);
    EXPECT_EQ(curve.packets.front().track.value_or(0), 0u);
    EXPECT_EQ(payloadOf(curve.packets), bytesOf(tracks));
    EXPECT_EQ(curve.points.back().bytes, bytesOf(tracks));
    std::vector<uint64_t> sent(count);
    uint64_t bytes = 0;
    for (const Packet& packet : curve.packets) {
      const Codewords before = prefixAfter(coded, curve.packets, bytes);
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(before[i].size(), sent[i]);
      EXPECT_EQ(packet.begin, sent[packet.track.value_or(0)]);
      sent[packet.track.value_or(0)] = packet.end;
      bytes += packet.length();
    }
    for (size_t i = 0; i < count; ++i) EXPECT_EQ(sent[i], tracks[i].codeword.size());
  }
}

}  // namespace
}  // namespace tetrakis
