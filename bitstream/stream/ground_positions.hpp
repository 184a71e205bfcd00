// SPDX-License-Identifier: Apache-2.0
// GroundPositions gives the longitudes and latitudes of a raster (docs/FORMAT.md, section 2, Ground
// positions) to receivers that do not know its reference system.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bitstream/stream/fields.hpp"

namespace tetrakis::inline stream {

/// In degrees. Longitudes go on behind 180 where a raster crosses it.
struct LongitudeLatitude {
  double longitude = 0, latitude = 0;
};

/// A place on the plane that touches the sphere of longitudes and latitudes, projected
/// stereographically: no pole and no date line breaks it, and most maps are nearly similar to it.
using TangentPoint = std::array<double, 2>;

/// The plane that touches at `centre`.
class TangentPlane {
 public:
  explicit TangentPlane(LongitudeLatitude centre);
  TangentPoint project(LongitudeLatitude place) const;
  LongitudeLatitude unproject(const TangentPoint& point) const;

 private:
  double longitude_, sine_, cosine_;
};

/// Polynomials of column and row that give points of a tangent plane.
struct GroundPositions {
  static constexpr uint8_t kMostDegree = 15, kMostExponent = 62;
  static constexpr int64_t kMostCoefficient = int64_t{1} << 50;

  int64_t longitude = 0, latitude = 0;  ///< degrees of the centre
  uint8_t degree = 1;
  uint8_t exponent = 0;  ///< coefficients count in units of 2^-exponent
  /// Of Chebyshev polynomials T_i(u) T_j(v) with i + j <= degree, row by row, of the first
  /// coordinate and then of the second.
  std::vector<int64_t> coefficients;

  static size_t terms(int degree) { return static_cast<size_t>(degree + 1) * (degree + 2) / 2; }

  /// u, v: -1 at the outer edge of the first column and row, 1 at that of the last ones.
  TangentPoint at(double u, double v) const;

  template <class V>
  void visit(V& v) {
    v.zigzag("longitude", longitude, 180);
    v.zigzag("latitude", latitude, 90);
    v.u8("degree", degree, 1, kMostDegree);
    v.u8("exponent", exponent, 0, kMostExponent);
    if (v.ok()) coefficients.resize(2 * terms(degree));
    for (int64_t& c : coefficients) v.zigzag("coefficient", c, kMostCoefficient);
  }
};

std::string written(const GroundPositions& positions);

/// Nothing if the bytes are of another form.
std::optional<GroundPositions> groundPositionsIn(const std::string& bytes);

/// T_0(x) to T_degree(x).
std::array<double, GroundPositions::kMostDegree + 1> chebyshev(double x, int degree);

}  // namespace tetrakis::inline stream
