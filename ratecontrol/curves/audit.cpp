// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/curves/component_curve.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline curves {

namespace {

// A prefix dips if its distortion exceeds that of a shorter one by more than this factor (0.03 dB),
// or by the smaller one where not every byte is measured. Larger factors let prefixes fall back
// further; with smaller ones more packets have to be whole.
constexpr double kDip = 1.0067, kSparseDip = 1.005;
// The first bytes, each of which is measured. More of them find more dips, and take time.
constexpr uint64_t kFirstBytes = 8192;
// Samples that the audit of a small track decodes in all, which takes a few tenths of a second.
// More of them find more dips.
constexpr uint64_t kDecodedSamples = uint64_t{1} << 23;
// Points behind the budget and this part of it are not measured between. A larger number saves
// time, and the end of the budget depends on fewer measurements.
constexpr uint64_t kBehindBudget = 4;
// The gain between two prefixes that are measured, in decibels for each sample, and the largest
// gain that counts. A smaller gain finds more dips, and takes time.
constexpr double kDecibelsPerSample = 2.5e-6, kMostDecibels = 6;
// The parts of the account at which large tracks are measured: if all of it is sent, and else. More
// of them correct the account better, and take the time of decoding a prefix each.
constexpr std::array kWholeParts = {0.5, 0.65, 0.8, 0.9};
constexpr std::array kOtherParts = {0.25, 0.5, 0.75};
// Fifths of the account of several tracks at which it is measured.
constexpr size_t kFifthsTogether = 3;

/// Collects the points that improve on all points before them, and notes whether prefixes between
/// them dip.
class Records {
 public:
  void add(const RatePoint& point, double dip) {
    if (points_.empty() || point.distortion < points_.back().distortion) {
      points_.push_back({point.bytes, point.distortion, dips_ || point.dips, point.beyond});
      dips_ = false;
    } else {
      dips_ |= point.dips || point.distortion > dip * points_.back().distortion;
    }
  }
  bool exact() const { return !points_.empty() && points_.back().distortion == 0; }
  /// Adds the end of a track even where its last bytes improve nothing.
  void keepEnd(uint64_t bytes) {
    constexpr double kLess = 1 - 1e-6;
    if (exact() || points_.back().bytes >= bytes) return;
    points_.push_back({bytes, kLess * points_.back().distortion, false, points_.back().beyond});
  }
  std::vector<RatePoint> take() { return std::move(points_); }

 private:
  std::vector<RatePoint> points_;
  bool dips_ = false;
};

/// How many prefixes to measure from each point of the account to the next.
class MeasuringPlan {
 public:
  MeasuringPlan(std::span<const RatePoint> points, const AuditScope& scope) : scope_(scope) {
    const uint64_t most = kDecodedSamples / scope.samples;
    first_bytes_ = std::min(kFirstBytes, most / 2);
    const uint64_t reach =
        scope.budget < UINT64_MAX / 2 ? scope.budget + scope.budget / kBehindBudget : UINT64_MAX;
    parts_.assign(points.size(), 1);
    uint64_t first = 0, later = 0;
    for (size_t i = 1; i < points.size(); ++i) {
      parts_[i] = wantedBetween(points[i - 1], points[i]);
      (points[i].bytes <= first_bytes_ ? first : later) += parts_[i];
    }
    const double share =
        std::min(1., static_cast<double>(most - first) / static_cast<double>(later));
    for (size_t i = 1; i < points.size(); ++i) {
      if (points[i].bytes > reach)
        parts_[i] = 1;
      else if (points[i].bytes > first_bytes_)
        parts_[i] = 1 + static_cast<uint64_t>(share * static_cast<double>(parts_[i] - 1));
    }
  }
  /// Between point i - 1 and point i: from 1 to as many as there are bytes.
  uint64_t between(size_t i) const { return parts_[i]; }

 private:
  /// The number of prefixes to measure. All prefixes of tiny tracks and of the first bytes are
  /// measured, where single coefficients count most. Elsewhere the quality of neighbours differs by
  /// 0.03 dB (in 12 288 samples, less in fewer), and they are no more than a few bytes apart,
  /// because passes of little gain often dip.
  uint64_t wantedBetween(const RatePoint& a, const RatePoint& b) const {
    const double gain =
        b.distortion > 0
            ? std::min(kMostDecibels, 10 * portable::log10(a.distortion / b.distortion))
            : kMostDecibels;
    const double wanted =
        std::ceil(gain / (kDecibelsPerSample * static_cast<double>(scope_.samples)));
    const uint64_t bytes = b.bytes - a.bytes;
    if (b.bytes <= first_bytes_) return bytes;
    return std::min(bytes, std::max(static_cast<uint64_t>(wanted),
                                    1 + bytes * (kTinySamples / 2) / scope_.samples));
  }

  AuditScope scope_;
  uint64_t first_bytes_ = 0;
  std::vector<uint64_t> parts_;
};

std::vector<RatePoint> measureClosely(const EncodedTrack& track, const AuditScope& scope,
                                      const Measure& measure) {
  const MeasuringPlan plan(track.points, scope);
  Records records;
  records.add({0, measure(0)}, kDip);
  for (size_t i = 1; i < track.points.size() && !records.exact(); ++i) {
    const RatePoint &a = track.points[i - 1], &b = track.points[i];
    assert(a.bytes < b.bytes);
    const uint64_t parts = plan.between(i);
    for (uint64_t k = 1; k <= parts && !records.exact(); ++k) {
      const uint64_t bytes = a.bytes + (b.bytes - a.bytes) * k / parts;
      records.add({bytes, measure(bytes)}, parts == b.bytes - a.bytes ? kDip : kSparseDip);
    }
  }
  if (scope.whole) records.keepEnd(track.points.back().bytes);
  return records.take();
}

/// The points whose distortion falls. An estimate is no evidence of a dip: a point that rises above
/// those before it is left out, and marks no dip.
std::vector<RatePoint> falling(std::span<const RatePoint> points, bool whole) {
  Records records;
  for (const RatePoint& point : points) records.add(point, std::numeric_limits<double>::infinity());
  if (whole) records.keepEnd(points.back().bytes);
  return records.take();
}

/// Interpolates the ratio of measured to stated distortion between a few points, over the logarithm
/// of the stated one.
class Correction {
 public:
  Correction(std::span<const RatePoint> points, const std::vector<size_t>& measured,
             const Measure& measure) {
    for (const size_t i : measured) {
      const double stated = points[i].squares();
      if (stated <= 0) continue;
      const double squares = measure(points[i].bytes);
      if (squares > 0) knots_.push_back({portable::log(stated), portable::log(squares / stated)});
    }
  }
  /// The factor that corrects a stated distortion.
  double operator()(double squares) const {
    if (squares <= 0 || knots_.empty()) return 1;
    const double x = portable::log(squares);  // knots fall in x
    const auto after =
        std::find_if(knots_.begin(), knots_.end(), [&](const Knot& k) { return k.x < x; });
    if (after == knots_.begin()) return portable::exp(knots_.front().ratio);
    if (after == knots_.end()) return portable::exp(knots_.back().ratio);
    const Knot &a = *(after - 1), &b = *after;
    return portable::exp(a.ratio + (b.ratio - a.ratio) * (a.x - x) / (a.x - b.x));
  }

 private:
  struct Knot {
    double x, ratio;
  };
  std::vector<Knot> knots_;
};

/// The last points of an account that is sent as a whole: the fewer coefficients are missing, the
/// more of the error comes from rounding samples. An exact end needs no measuring.
std::vector<size_t> pointsNearEnd(std::span<const RatePoint> points) {
  std::vector<size_t> near;
  if (points.size() > 1) near.push_back(points.size() - 2);
  if (points.back().squares() > 0) near.push_back(points.size() - 1);
  return near;
}

/// The points to measure of an account that is not measured as a whole. If all of it is sent, they
/// lie later.
std::vector<size_t> pointsToMeasure(std::span<const RatePoint> points, bool whole) {
  std::vector<size_t> measured;
  for (const double part : whole ? std::span<const double>(kWholeParts) : kOtherParts)
    measured.push_back(static_cast<size_t>(part * static_cast<double>(points.size() - 1)));
  if (!whole) return measured;
  for (const size_t point : pointsNearEnd(points)) measured.push_back(point);
  return measured;
}

std::vector<RatePoint> scaled(std::span<const RatePoint> points, const Correction& correction) {
  std::vector<RatePoint> corrected(points.begin(), points.end());
  for (RatePoint& point : corrected) {
    const double factor = correction(point.squares());
    point.distortion *= factor;
    point.beyond *= factor;
  }
  return corrected;
}

}  // namespace

std::vector<RatePoint> audit(const EncodedTrack& track, const AuditScope& scope,
                             const Measure& measure) {
  // Squared errors of samples ignore priorities.
  const bool alike = std::all_of(track.points.begin(), track.points.end(),
                                 [](const RatePoint& point) { return point.beyond == 0; });
  if (alike && scope.samples <= kSmallSamples) return measureClosely(track, scope, measure);
  const std::span<const RatePoint> points = track.points;
  if (scope.budget < UINT64_MAX) return falling(points, scope.whole);
  const bool whole = scope.whole || points.back().squares() == 0;
  return falling(scaled(points, {points, pointsToMeasure(points, whole), measure}), scope.whole);
}

std::vector<RatePoint> auditTogether(std::span<const RatePoint> points, const AuditScope& scope,
                                     const Measure& measure) {
  const bool exact = points.back().squares() == 0;
  if (points.size() < 2 || !(exact || scope.budget == UINT64_MAX))
    return {points.begin(), points.end()};
  std::vector<size_t> measured = {points.size() * kFifthsTogether / 5};
  for (const size_t point : pointsNearEnd(points)) measured.push_back(point);
  return scaled(points, {points, measured, measure});
}

}  // namespace tetrakis::inline curves
