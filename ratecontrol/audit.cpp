// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/audit.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tetrakis {

namespace {

constexpr double kDip = 1.005;  // 0.02 dB, inside the 0.03 dB that a prefix may fall

std::vector<RatePoint> measureEveryByte(uint64_t bytes, const Measure& measure) {
  std::vector<RatePoint> points = {{0, measure(0)}};
  bool dips = false;
  for (uint64_t n = 1; n <= bytes; ++n) {
    const double distortion = measure(n);
    dips |= distortion > kDip * points.back().distortion;
    if (distortion >= points.back().distortion) continue;
    points.push_back({n, distortion, dips});
    dips = false;
  }
  return points;
}

/// Keeps the points that improve on all before them.
std::vector<RatePoint> falling(std::span<const RatePoint> points) {
  std::vector<RatePoint> kept = {points.front()};
  bool dips = false;
  for (const RatePoint& point : points.subspan(1)) {
    dips |= point.dips;
    if (point.distortion >= kept.back().distortion) continue;
    kept.push_back({point.bytes, point.distortion, dips});
    dips = false;
  }
  return kept;
}

/// Ratio of measured to stated distortion at a few points, interpolated over the logarithm of the
/// stated one.
class Correction {
 public:
  Correction(std::span<const RatePoint> points, size_t measurements, const Measure& measure) {
    for (size_t i = 0; i < measurements; ++i) {
      const RatePoint& point = points[(points.size() - 1) * (i + 1) / (measurements + 1)];
      if (point.distortion <= 0) continue;
      const double measured = measure(point.bytes);
      if (measured > 0)
        knots_.push_back({std::log(point.distortion), std::log(measured / point.distortion)});
    }
  }
  double operator()(double distortion) const {
    if (distortion <= 0 || knots_.empty()) return distortion;
    const double x = std::log(distortion);  // knots fall in x
    const auto after =
        std::find_if(knots_.begin(), knots_.end(), [&](const Knot& k) { return k.x < x; });
    if (after == knots_.begin()) return distortion * std::exp(knots_.front().ratio);
    if (after == knots_.end()) return distortion * std::exp(knots_.back().ratio);
    const Knot &a = *(after - 1), &b = *after;
    return distortion * std::exp(a.ratio + (b.ratio - a.ratio) * (a.x - x) / (a.x - b.x));
  }

 private:
  struct Knot {
    double x, ratio;
  };
  std::vector<Knot> knots_;
};

}  // namespace

std::vector<RatePoint> audit(const EncodedTrack& track, uint64_t samples, bool budgeted,
                             const Measure& measure) {
  if (samples <= kTinySamples) return measureEveryByte(track.codeword.size(), measure);
  std::vector<RatePoint> corrected = track.points;
  if (samples <= kSmallSamples) {
    for (RatePoint& point : corrected) point.distortion = measure(point.bytes);
  } else if (!budgeted) {
    const Correction correction(track.points, kLargeMeasurements, measure);
    for (RatePoint& point : corrected) point.distortion = correction(point.distortion);
  }
  return falling(corrected);
}

}  // namespace tetrakis
