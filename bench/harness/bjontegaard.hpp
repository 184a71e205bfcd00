// SPDX-License-Identifier: Apache-2.0
// Bjøntegaard's rate difference between two rate-distortion curves: the mean of the horizontal
// distance between them, log(rate) over PSNR (Bjøntegaard, VCEG-M33, 2001). His cubic polynomial
// overshoots on more than four points, so the curves are interpolated by monotone cubics instead
// (Fritsch and Carlson 1980; as JVET and AOM do today).
#pragma once

#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// One measured operating point. rate > 0 in any unit both curves share; psnr in dB.
struct RatePoint {
  double rate = 0;
  double psnr = 0;
};

/// Piecewise cubic Hermite interpolant that is monotone wherever the data are. Slopes: weighted
/// harmonic means of the neighbouring secants (Fritsch and Butland 1984), the choice of PCHIP.
class MonotoneCubic {
 public:
  /// x strictly increasing, as many y as x, two or more of them.
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  /// The interpolant at t; outside the data the nearest end's value.
  double at(double t) const;

  /// The exact integral over [from, to], which must lie inside the data.
  double integral(double from, double to) const;

  double low() const { return x_.front(); }
  double high() const { return x_.back(); }

 private:
  std::vector<double> x_, y_, slope_;
};

/// The points that no other point beats (fewer or equal bits at equal or better quality), by
/// rising rate; both coordinates then rise strictly. Points of infinite PSNR are left out.
std::vector<RatePoint> paretoFront(std::vector<RatePoint> points);

/// The best of several curves (a codec's settings) at every rate that one of them was measured at.
/// Each is interpolated by itself: one curve through the mixed points would swing between them.
/// Curves of fewer than two points on their Pareto front are left out.
std::vector<RatePoint> upperEnvelope(const std::vector<std::vector<RatePoint>>& curves);

/// PSNR over log10(rate) of the Pareto front of `points`, of which two or more must remain.
Result<MonotoneCubic> qualityOverLogRate(const std::vector<RatePoint>& points);

/// Rates of the anchor between which curves are compared.
struct RateWindow {
  double low = 0;
  double high = 0;
};

struct RateDifference {
  double ratio = 0;  ///< mean rate(test) / rate(anchor) - 1; negative: test is better
  double psnr_low = 0, psnr_high = 0;  ///< the interval of quality it is the mean over, dB
};

/// Compares over the qualities that the anchor has within the window and the test reaches too.
/// TKS_USAGE when either curve has fewer than two points or they share no quality.
Result<RateDifference> rateDifference(const std::vector<RatePoint>& anchor,
                                      const std::vector<RatePoint>& test, RateWindow window);

}  // namespace tetrakis::bench
