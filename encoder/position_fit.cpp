// SPDX-License-Identifier: Apache-2.0
#include "encoder/encode_stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace tetrakis::inline encoder {

namespace {

/// Along each side: zeros of T_kNodes, at which Chebyshev polynomials are orthogonal.
constexpr int kNodes = 2 * GroundPositions::kMostDegree;
/// Along each side, edges included, the places at which errors are measured. More of them find
/// larger errors between the nodes, and take time by their square.
constexpr int kChecks = 41;
/// Places farther from the centre of the tangent plane, in radii of the sphere, have no positions:
/// 8 are 152 degrees. A larger number accepts places where a polynomial needs many terms.
constexpr double kFarthest = 8;
constexpr uint8_t kFinest = 46;  // coefficients stay below kMostCoefficient

double node(int i) {
  return std::cos(std::numbers::pi * (i + 0.5) / kNodes);
}

double check(int i) {
  return 2.0 * i / (kChecks - 1) - 1;
}

/// Points of the tangent plane at a square of places; nothing if one of these has none.
template <class At>
std::optional<std::vector<TangentPoint>> pointsAt(const Locator& locate, const TangentPlane& plane,
                                                  int side, At at) {
  std::vector<TangentPoint> points;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const auto place = locate(at(i), at(j));
      if (!place) return std::nullopt;
      const TangentPoint point = plane.project(*place);
      if (!(std::abs(point[0]) < kFarthest && std::abs(point[1]) < kFarthest)) return std::nullopt;
      points.push_back(point);
    }
  }
  return points;
}

/// Coefficients of T_i(u) T_j(v) for i, j <= kMostDegree, of one coordinate: sums over the nodes.
using Series = std::array<std::array<double, GroundPositions::kMostDegree + 1>,
                          GroundPositions::kMostDegree + 1>;

Series seriesOf(const std::vector<TangentPoint>& points, size_t coordinate) {
  Series series{};
  for (int b = 0; b < kNodes; ++b) {
    const auto down = chebyshev(node(b), GroundPositions::kMostDegree);
    for (int a = 0; a < kNodes; ++a) {
      const auto along = chebyshev(node(a), GroundPositions::kMostDegree);
      const double value = points[static_cast<size_t>(b * kNodes + a)][coordinate];
      for (size_t j = 0; j < series.size(); ++j) {
        for (size_t i = 0; i < series.size(); ++i) {
          const double norm = (i > 0 ? 2.0 : 1.0) * (j > 0 ? 2.0 : 1.0) / (kNodes * kNodes);
          series[j][i] += norm * value * along[i] * down[j];
        }
      }
    }
  }
  return series;
}

/// How many samples a step on the plane spans, at worst, around a place.
struct SampleSizes {
  std::vector<double> per_unit;

  /// From differences between the places that are checked.
  SampleSizes(const std::vector<TangentPoint>& points, const PositionFit& wish) {
    const auto gap = [&](size_t a, size_t b) {
      return std::hypot(points[b][0] - points[a][0], points[b][1] - points[a][1]);
    };
    for (size_t j = 0; j < kChecks; ++j) {
      for (size_t i = 0; i < kChecks; ++i) {
        const size_t at = j * kChecks + i;
        const double along = gap(i > 0 ? at - 1 : at, i > 0 ? at : at + 1) * (kChecks - 1);
        const double down =
            gap(j > 0 ? at - kChecks : at, j > 0 ? at : at + kChecks) * (kChecks - 1);
        per_unit.push_back(std::max(wish.columns / along, wish.rows / down));
      }
    }
  }
};

/// The places and sizes with which the polynomials are compared.
struct Target {
  std::vector<TangentPoint> points;
  SampleSizes sizes;

  /// The largest distance, in samples.
  double errorOf(const GroundPositions& positions) const {
    double worst = 0;
    for (size_t at = 0; at < points.size(); ++at) {
      const TangentPoint point = positions.at(check(static_cast<int>(at % kChecks)),
                                              check(static_cast<int>(at / kChecks)));
      const double away = std::hypot(point[0] - points[at][0], point[1] - points[at][1]);
      worst = std::max(worst, away * sizes.per_unit[at]);
    }
    return worst;
  }
};

/// The series in whole numbers, as far as its degree goes.
GroundPositions rounded(const std::array<Series, 2>& series, GroundPositions frame) {
  frame.coefficients.clear();
  for (const Series& coordinate : series) {
    for (size_t j = 0; j <= frame.degree; ++j) {
      for (size_t i = 0; i + j <= frame.degree; ++i)
        frame.coefficients.push_back(std::llround(std::ldexp(coordinate[j][i], frame.exponent)));
    }
  }
  return frame;
}

/// Polynomials of one degree with the coarsest unit that meets the tolerance.
std::optional<GroundPositions> coarsest(const std::array<Series, 2>& series, const Target& target,
                                        GroundPositions frame, double tolerance) {
  frame.exponent = kFinest;
  if (target.errorOf(rounded(series, frame)) > tolerance) return std::nullopt;
  // The error of rounding halves from unit to unit, apart from chance.
  uint8_t fails = 0, meets = kFinest;
  while (meets - fails > 1) {
    frame.exponent = static_cast<uint8_t>((fails + meets) / 2);
    (target.errorOf(rounded(series, frame)) > tolerance ? fails : meets) = frame.exponent;
  }
  frame.exponent = meets;
  return rounded(series, frame);
}

}  // namespace

std::optional<GroundPositions> fitPositions(const Locator& locate, const PositionFit& wish) {
  const auto middle = locate(0, 0);
  if (!middle || !(std::abs(middle->latitude) <= 90) || !std::isfinite(middle->longitude))
    return std::nullopt;
  GroundPositions frame;
  frame.longitude = std::lround(std::remainder(middle->longitude, 360));
  frame.latitude = std::lround(middle->latitude);
  const TangentPlane plane(
      {static_cast<double>(frame.longitude), static_cast<double>(frame.latitude)});
  const auto nodes = pointsAt(locate, plane, kNodes, node);
  auto checks = pointsAt(locate, plane, kChecks, check);
  if (!nodes || !checks) return std::nullopt;
  const std::array<Series, 2> series = {seriesOf(*nodes, 0), seriesOf(*nodes, 1)};
  const SampleSizes sizes(*checks, wish);
  const Target target{std::move(*checks), sizes};
  std::optional<GroundPositions> best;
  size_t fewest = wish.most_bytes + 1;
  for (uint8_t degree = 1; 2 * GroundPositions::terms(degree) < fewest; ++degree) {
    if (degree > GroundPositions::kMostDegree) break;
    frame.degree = degree;
    const auto fitted = coarsest(series, target, frame, wish.tolerance);
    if (!fitted || written(*fitted).size() >= fewest) continue;
    fewest = written(*fitted).size();
    best = fitted;
  }
  return best;
}

}  // namespace tetrakis::inline encoder
