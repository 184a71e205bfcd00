// SPDX-License-Identifier: Apache-2.0
// Bjøntegaard's rate difference by monotone cubic interpolation; see bjontegaard.hpp.
#include "bench/harness/bjontegaard.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::bench {
namespace {

// Three-point end slope, held back so that the end stays monotone (Moler, Numerical Computing with
// MATLAB, section 3.6). h0, d0: width and secant of the end interval; h1, d1: of its neighbour.
double endSlope(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

std::vector<double> pchipSlopes(const std::vector<double>& x, const std::vector<double>& y) {
  const size_t n = x.size();
  std::vector<double> h(n - 1), d(n - 1), slope(n);
  for (size_t i = 0; i + 1 < n; ++i) {
    h[i] = x[i + 1] - x[i];
    d[i] = (y[i + 1] - y[i]) / h[i];
  }
  if (n == 2) return {d[0], d[0]};
  for (size_t i = 1; i + 1 < n; ++i) {
    if (d[i - 1] * d[i] <= 0) continue;  // a turning point: flat
    const double w0 = 2 * h[i] + h[i - 1], w1 = h[i] + 2 * h[i - 1];
    slope[i] = (w0 + w1) / (w0 / d[i - 1] + w1 / d[i]);
  }
  slope[0] = endSlope(h[0], h[1], d[0], d[1]);
  slope[n - 1] = endSlope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  return slope;
}

// log10(rate) over PSNR: the axis that Bjøntegaard integrates along.
MonotoneCubic logRateOverQuality(const std::vector<RatePoint>& front) {
  std::vector<double> x, y;
  for (const RatePoint& p : front) {
    x.push_back(p.psnr);
    y.push_back(std::log10(p.rate));
  }
  return {std::move(x), std::move(y)};
}

}  // namespace

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(pchipSlopes(x_, y_)) {}

double MonotoneCubic::at(double t) const {
  t = std::clamp(t, low(), high());
  const auto right = std::upper_bound(x_.begin() + 1, x_.end() - 1, t);
  const size_t i = static_cast<size_t>(right - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], s = (t - x_[i]) / h, r = 1 - s;
  return y_[i] * (1 + 2 * s) * r * r + y_[i + 1] * (1 + 2 * r) * s * s +
         h * s * r * (slope_[i] * r - slope_[i + 1] * s);
}

double MonotoneCubic::integral(double from, double to) const {
  double sum = 0;
  for (size_t i = 0; i + 1 < x_.size(); ++i) {
    const double a = std::max(from, x_[i]), b = std::min(to, x_[i + 1]);
    if (a >= b) continue;
    sum += (b - a) / 6 * (at(a) + 4 * at((a + b) / 2) + at(b));  // Simpson: exact for cubics
  }
  return sum;
}

std::vector<RatePoint> paretoFront(std::vector<RatePoint> points) {
  std::sort(points.begin(), points.end(), [](const RatePoint& a, const RatePoint& b) {
    return a.rate != b.rate ? a.rate < b.rate : a.psnr > b.psnr;
  });
  std::vector<RatePoint> front;
  for (const RatePoint& p : points) {
    if (std::isfinite(p.psnr) && (front.empty() || p.psnr > front.back().psnr)) front.push_back(p);
  }
  return front;
}

Result<MonotoneCubic> qualityOverLogRate(const std::vector<RatePoint>& points) {
  std::vector<double> x, y;
  for (const RatePoint& p : paretoFront(points)) {
    x.push_back(std::log10(p.rate));
    y.push_back(p.psnr);
  }
  if (x.size() < 2) return Status(TKS_USAGE, "A curve needs two points of different quality.");
  return MonotoneCubic(std::move(x), std::move(y));
}

std::vector<RatePoint> upperEnvelope(const std::vector<std::vector<RatePoint>>& curves) {
  std::vector<MonotoneCubic> qualities;
  std::vector<RatePoint> envelope;
  for (const std::vector<RatePoint>& curve : curves) {
    const Result<MonotoneCubic> quality = qualityOverLogRate(curve);
    if (!quality.ok()) continue;
    qualities.push_back(*quality);
    const std::vector<RatePoint> front = paretoFront(curve);
    envelope.insert(envelope.end(), front.begin(), front.end());
  }
  for (RatePoint& p : envelope) {
    const double log_rate = std::log10(p.rate);
    for (const MonotoneCubic& quality : qualities) {
      if (log_rate >= quality.low()) p.psnr = std::max(p.psnr, quality.at(log_rate));
    }
  }
  return paretoFront(std::move(envelope));
}

Result<RateDifference> rateDifference(const std::vector<RatePoint>& anchor,
                                      const std::vector<RatePoint>& test, RateWindow window) {
  const Result<MonotoneCubic> quality = qualityOverLogRate(anchor);
  if (!quality.ok()) return quality.status();
  const std::vector<RatePoint> test_front = paretoFront(test);
  if (test_front.size() < 2) {
    return Status(TKS_USAGE, "A curve needs two points of different quality.");
  }
  const MonotoneCubic reference = logRateOverQuality(paretoFront(anchor));
  const MonotoneCubic candidate = logRateOverQuality(test_front);
  RateDifference result;
  result.psnr_low = std::max(quality->at(std::log10(window.low)), candidate.low());
  result.psnr_high = std::min(quality->at(std::log10(window.high)), candidate.high());
  if (result.psnr_low >= result.psnr_high) {
    return Status(TKS_USAGE, "The two curves share no quality within the window of rates.");
  }
  const double distance = candidate.integral(result.psnr_low, result.psnr_high) -
                          reference.integral(result.psnr_low, result.psnr_high);
  result.ratio = std::pow(10, distance / (result.psnr_high - result.psnr_low)) - 1;
  return result;
}

}  // namespace tetrakis::bench
