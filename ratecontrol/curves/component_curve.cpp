// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/curves/component_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace tetrakis::inline curves {

Codewords codewordsOf(std::span<const EncodedTrack> tracks) {
  Codewords codewords;
  for (const EncodedTrack& track : tracks) codewords.push_back(track.codeword);
  return codewords;
}

double distortionAt(std::span<const RatePoint> points, uint64_t bytes) {
  const auto after = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& point) { return point.bytes > bytes; });
  if (after == points.begin() || after == points.end()) return points.back().distortion;
  const RatePoint &a = *(after - 1), &b = *after;
  const double t = static_cast<double>(bytes - a.bytes) / static_cast<double>(b.bytes - a.bytes);
  return a.distortion + t * (b.distortion - a.distortion);
}

Codewords prefixAfter(const CodedTracks& coded, std::span<const Packet> packets, uint64_t bytes) {
  const Codewords all = codewordsOf(coded.tracks);
  const uint64_t most = bytesOf(coded.tracks);
  assert(!all.empty() && bytes <= most);
  if (all.size() == 1) return {all.front().first(bytes)};
  if (bytes == most) return all;
  Codewords cut(all.size());
  for (const Packet& packet : packets) {
    if (packet.component != coded.component) continue;
    assert(packet.track && *packet.track < all.size());
    const uint64_t taken = std::min(bytes, packet.length());
    cut[*packet.track] = all[*packet.track].first(packet.begin + taken);
    bytes -= taken;
    if (bytes == 0) break;
  }
  return cut;
}

namespace {

/// A packet is at least this fraction of its track's bytes before it: heads stay below 1 %. A
/// larger fraction saves bytes of heads, and orders both components in longer pieces.
constexpr double kPacketGrowth = 0.1;
/// The slope of the opening over the steepest slope behind it. It exceeds 1, so that rounding does
/// not let other bytes come first.
constexpr double kOpeningSlope = 1.01;
/// The least bytes of the parts of a packet, whose heads take 2 % of them, and the parts' share of
/// the track's bytes so far. Smaller parts follow what is seen more closely, and take time.
constexpr uint64_t kLeastPart = 256;
constexpr double kPartShare = 0.06;

/// Raises the first point so that the first `opening` bytes have the steepest slope of all, because
/// all other bytes need them.
void favour(std::vector<RatePoint>& points, uint64_t opening) {
  double steepest = 0;
  const auto opened = std::find_if(points.begin(), points.end(),
                                   [&](const RatePoint& p) { return p.bytes >= opening; });
  if (opened == points.begin() || opened == points.end()) return;
  for (auto p = opened + 1; p != points.end(); ++p) {
    const auto bytes = static_cast<double>(p->bytes - opened->bytes);
    steepest = std::max(steepest, (opened->distortion - p->distortion) / bytes);
  }
  const double worth = kOpeningSlope * steepest * static_cast<double>(opened->bytes);
  points.front().distortion = std::max(points.front().distortion, opened->distortion + worth);
}

uint8_t statedQuality(double squares, const Pricing& pricing) {
  return qualityOf(std::sqrt(squares / pricing.samples));
}

double costOf(double squares, const Pricing& pricing) {
  return std::max(squares / pricing.samples, pricing.floor);
}

/// The first point behind the opening. points: of a hull.
size_t openedAt(const std::vector<RatePoint>& points, uint64_t opening) {
  size_t first = 0;
  while (first + 1 < points.size() && points[first].bytes < opening) ++first;
  return first;
}

/// The places where a packet is divided, so that no step of the allocation is long: single passes
/// over the finest bands take a quarter of all bytes so far. Parts that stay neighbours are joined
/// again.
std::vector<uint64_t> divided(uint64_t begin, uint64_t end) {
  const auto most =
      std::max(kLeastPart, static_cast<uint64_t>(kPartShare * static_cast<double>(begin)));
  const uint64_t parts = std::max<uint64_t>(1, (end - begin) / most);
  std::vector<uint64_t> ends;
  for (uint64_t i = 1; i <= parts; ++i) ends.push_back(begin + (end - begin) * i / parts);
  return ends;
}

/// The quality that the last point within `bytes` bytes states.
uint8_t qualityWithin(const std::map<uint64_t, uint8_t>& quality, uint64_t bytes) {
  return std::prev(quality.upper_bound(bytes))->second;
}

/// The point after `bytes` bytes on the chord of two points.
RatePoint between(const RatePoint& a, const RatePoint& b, uint64_t bytes) {
  const double rest = static_cast<double>(b.bytes - bytes) / static_cast<double>(b.bytes - a.bytes);
  return {bytes, b.distortion + (a.distortion - b.distortion) * rest};
}

/// points: of the only track, audited.
ComponentCurve curveOfOne(const CodedTracks& coded, std::vector<RatePoint> points,
                          const Pricing& pricing) {
  std::map<uint64_t, uint8_t> quality;
  for (RatePoint& point : points) {
    quality[point.bytes] = statedQuality(point.squares(), pricing);
    point.distortion = costOf(point.distortion, pricing);
  }
  std::vector<RatePoint> behind_opening;
  for (const RatePoint& point : points)
    if (point.bytes >= coded.opening) behind_opening.push_back(point);
  favour(points, coded.opening);
  const std::vector<RatePoint> hull = lowerHull(points, kPacketGrowth);
  ComponentCurve curve{{hull.front()}, {}};
  curve.passes = std::move(behind_opening);
  uint64_t begin = 0;
  for (size_t i = 1; i < hull.size(); ++i) {
    for (const RatePoint& end : packetEnds(points, hull[i - 1], hull[i])) {
      const bool divisible = pricing.shared && !end.dips && begin >= coded.opening;
      for (const uint64_t part : divisible ? divided(begin, end.bytes) : std::vector{end.bytes}) {
        curve.packets.push_back(
            {coded.component, end.dips, qualityWithin(quality, part), begin, part, {}});
        begin = part;
        if (divisible) curve.points.push_back(between(hull[i - 1], hull[i], part));
      }
    }
    if (curve.points.back().bytes < begin) curve.points.push_back(hull[i]);
  }
  assert(begin == hull.back().bytes);
  curve.points.back() = hull.back();
  curve.opened = openedAt(curve.points, coded.opening);
  return curve;
}

ComponentCurve curveOfMany(const CodedTracks& coded, const AuditScope& scope,
                           const MeasurePackets& measure, const Pricing& pricing) {
  OrderedTracks tracks = orderTracks(coded, pricing.order);
  tracks.points = auditTogether(tracks.points, scope,
                                [&](uint64_t bytes) { return measure(tracks.packets, bytes); });
  for (size_t i = 0; i < tracks.packets.size(); ++i)
    tracks.packets[i].quality = statedQuality(tracks.points[i + 1].squares(), pricing);
  for (RatePoint& point : tracks.points) point.distortion = costOf(point.distortion, pricing);
  favour(tracks.points, coded.opening);
  ComponentCurve curve{lowerHull(tracks.points, 0), std::move(tracks.packets)};
  curve.opened = openedAt(curve.points, coded.opening);
  return curve;
}

}  // namespace

ComponentCurve curveOf(const CodedTracks& coded, const AuditScope& scope,
                       const MeasurePackets& measure, const Pricing& pricing) {
  assert(!coded.tracks.empty() && pricing.samples > 0);
  if (coded.tracks.size() > 1) return curveOfMany(coded, scope, measure, pricing);
  const auto measure_track = [&](uint64_t bytes) { return measure({}, bytes); };
  ComponentCurve curve =
      curveOfOne(coded, audit(coded.tracks.front(), scope, measure_track), pricing);
  if (scope.samples <= kSmallSamples) curve.passes.clear();  // prefixes of any length are measured
  return curve;
}

}  // namespace tetrakis::inline curves
