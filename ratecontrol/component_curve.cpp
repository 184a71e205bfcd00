// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/component_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "ratecontrol/hull.hpp"
#include "ratecontrol/track_order.hpp"

namespace tetrakis {

namespace {

/// A packet is at least this fraction of its track's bytes before it: heads stay below 1 %.
constexpr double kPacketGrowth = 0.1;

/// Raises the first point so that the first `opening` bytes are worth the most of all: what they
/// hold, the rest needs.
void favour(std::vector<RatePoint>& points, uint64_t opening) {
  double steepest = 0;
  const auto opened = std::find_if(points.begin(), points.end(),
                                   [&](const RatePoint& p) { return p.bytes >= opening; });
  if (opened == points.begin() || opened == points.end()) return;
  for (auto p = opened + 1; p != points.end(); ++p) {
    const auto bytes = static_cast<double>(p->bytes - opened->bytes);
    steepest = std::max(steepest, (opened->distortion - p->distortion) / bytes);
  }
  const double worth = 1.01 * steepest * static_cast<double>(opened->bytes);
  points.front().distortion = std::max(points.front().distortion, opened->distortion + worth);
}

uint8_t statedQuality(double squares, const Pricing& pricing) {
  return qualityOf(std::sqrt(squares / pricing.samples));
}

double costOf(double squares, const Pricing& pricing) {
  return std::max(squares / pricing.samples, pricing.floor);
}

/// points: of a hull.
size_t openedAt(const std::vector<RatePoint>& points, uint64_t opening) {
  size_t first = 0;
  while (first + 1 < points.size() && points[first].bytes < opening) ++first;
  return first;
}

/// points: of the only track, audited.
ComponentCurve curveOfOne(const CodedTracks& coded, std::vector<RatePoint> points,
                          const Pricing& pricing) {
  std::map<uint64_t, uint8_t> quality;
  for (RatePoint& point : points) {
    quality[point.bytes] = statedQuality(point.distortion, pricing);
    point.distortion = costOf(point.distortion, pricing);
  }
  favour(points, coded.opening);
  ComponentCurve curve{lowerHull(points, kPacketGrowth), {}};
  curve.opened = openedAt(curve.points, coded.opening);
  uint64_t begin = 0;
  for (size_t i = 1; i < curve.points.size(); ++i) {
    for (const RatePoint& end : packetEnds(points, curve.points[i - 1], curve.points[i])) {
      curve.packets.push_back(
          {coded.component, end.dips, quality[end.bytes], begin, end.bytes, {}});
      begin = end.bytes;
    }
  }
  assert(begin == curve.points.back().bytes);
  return curve;
}

ComponentCurve curveOfMany(const CodedTracks& coded, const Pricing& pricing) {
  OrderedTracks tracks = orderTracks(coded);
  for (size_t i = 0; i < tracks.packets.size(); ++i)
    tracks.packets[i].quality = statedQuality(tracks.points[i + 1].distortion, pricing);
  for (RatePoint& point : tracks.points) point.distortion = costOf(point.distortion, pricing);
  favour(tracks.points, coded.opening);
  ComponentCurve curve{lowerHull(tracks.points, 0), std::move(tracks.packets)};
  curve.opened = openedAt(curve.points, coded.opening);
  return curve;
}

}  // namespace

ComponentCurve curveOf(const CodedTracks& coded, const AuditScope& scope, const Measure& measure,
                       const Pricing& pricing) {
  assert(!coded.tracks.empty() && pricing.samples >= 1);
  if (coded.tracks.size() > 1) return curveOfMany(coded, pricing);
  return curveOfOne(coded, audit(coded.tracks.front(), scope, measure), pricing);
}

}  // namespace tetrakis
