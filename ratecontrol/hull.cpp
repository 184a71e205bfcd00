// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/hull.hpp"

#include <algorithm>

namespace tetrakis {

namespace {

/// b lies on or above the chord from a to c.
bool above(const RatePoint& a, const RatePoint& b, const RatePoint& c) {
  const auto ab = static_cast<double>(b.bytes - a.bytes),
             ac = static_cast<double>(c.bytes - a.bytes);
  return (a.distortion - b.distortion) * ac <= (a.distortion - c.distortion) * ab;
}

}  // namespace

std::vector<RatePoint> lowerHull(std::span<const RatePoint> points, double growth) {
  std::vector<RatePoint> hull;  // monotone chain (A. M. Andrew 1979)
  for (RatePoint point : points) {
    while (hull.size() >= 2 && above(hull[hull.size() - 2], hull.back(), point)) {
      point.dips |= hull.back().dips;
      hull.pop_back();
    }
    hull.push_back(point);
  }
  std::vector<RatePoint> sparse;
  bool dips = false;
  for (size_t i = 0; i < hull.size(); ++i) {
    dips |= hull[i].dips;
    if (!sparse.empty() && i + 1 < hull.size()) {
      const uint64_t from = sparse.back().bytes;
      const auto least = std::max<uint64_t>(
          kLeastPacket, static_cast<uint64_t>(growth * static_cast<double>(from)));
      if (hull[i].bytes - from < least) continue;
    }
    sparse.push_back(hull[i]);
    sparse.back().dips = dips;
    dips = false;
  }
  return sparse;
}

}  // namespace tetrakis
