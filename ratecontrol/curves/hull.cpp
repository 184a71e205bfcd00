// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/curves/hull.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline curves {

namespace {

/// The part of the bytes before it that a packet beside a dip has at least. A larger number cuts
/// more dips out exactly, and takes bytes of heads.
constexpr uint64_t kPartOfTrack = 64;

/// b lies on or above the chord from a to c.
bool above(const RatePoint& a, const RatePoint& b, const RatePoint& c) {
  const auto ab = static_cast<double>(b.bytes - a.bytes),
             ac = static_cast<double>(c.bytes - a.bytes);
  return (a.distortion - b.distortion) * ac <= (a.distortion - c.distortion) * ab;
}

/// Packets shorter than this are not worth their heads.
uint64_t leastPart(uint64_t begin) {
  return std::max<uint64_t>(kLeastPacket, begin / kPartOfTrack);
}

}  // namespace

std::vector<RatePoint> lowerHull(std::span<const RatePoint> points, double growth) {
  assert(!points.empty());
  std::vector<RatePoint> hull;  // monotone chain (A. M. Andrew 1979)
  for (const RatePoint& point : points) {
    while (hull.size() >= 2 && above(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  std::vector<RatePoint> sparse;
  for (size_t i = 0; i < hull.size(); ++i) {
    if (!sparse.empty() && i + 1 < hull.size()) {
      const uint64_t from = sparse.back().bytes;
      const auto least = std::max<uint64_t>(
          kLeastPacket, static_cast<uint64_t>(growth * static_cast<double>(from)));
      if (hull[i].bytes - from < least) continue;
    }
    sparse.push_back(hull[i]);
  }
  assert(sparse.back().bytes == points.back().bytes);
  return sparse;
}

std::vector<RatePoint> packetEnds(std::span<const RatePoint> points, const RatePoint& from,
                                  const RatePoint& to) {
  assert(from.bytes < to.bytes);
  std::vector<RatePoint> ends;
  RatePoint before = from, last = from;  // the point before, the end of the packet before
  const auto end = [&](const RatePoint& point, bool dips) {
    last = point;
    ends.push_back({point.bytes, point.distortion, dips, point.beyond});
  };
  const auto is_short = [&](const RatePoint& point) {
    return point.bytes - last.bytes < leastPart(last.bytes);
  };
  auto p = std::upper_bound(points.begin(), points.end(), from.bytes,
                            [](uint64_t bytes, const RatePoint& q) { return bytes < q.bytes; });
  for (; p != points.end() && p->bytes <= to.bytes; before = *p++) {
    if (!p->dips) continue;
    if (!is_short(before)) {
      end(before, false);
    } else if (!ends.empty()) {
      ends.pop_back();  // it dips as well: one packet
    }
    end(*p, true);
  }
  if (last.bytes == to.bytes) return ends;
  const bool joined = !ends.empty() && is_short(to);
  if (joined) ends.pop_back();
  end(to, joined);
  assert(ends.back().bytes == to.bytes);
  return ends;
}

}  // namespace tetrakis::inline curves
