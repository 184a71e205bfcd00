// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/place/ground_axes.hpp"

#include <cmath>

#include "apps/tools/files/place/crs_units.hpp"
#include "apps/tools/files/place/earth.hpp"

namespace tetrakis::tools {

GroundAxes groundAxes(const GeoTransform& t, uint32_t width, uint32_t height,
                      const std::string& crs) {
  MetresPerDegree metres{1, 1};
  if (const double degrees = crs.empty() ? 0 : degreesPerUnit(crs); degrees > 0)
    metres = metresPerDegree((t[3] + width / 2.0 * t[4] + height / 2.0 * t[5]) * degrees);
  const auto direction = [&metres](double east, double north) {
    const double x = east * metres.east, y = north * metres.north, length = std::hypot(x, y);
    return std::array<double, 2>{x / length, -y / length};
  };
  const GroundAxes axes{direction(t[1], t[4]), direction(t[2], t[5])};
  constexpr double kLeastSine = 1e-6;  // of the angle between rows and columns
  const double sine = axes.along[0] * axes.down[1] - axes.along[1] * axes.down[0];
  return std::abs(sine) >= kLeastSine ? axes : GroundAxes();
}

QuarterTurn::QuarterTurn(const GroundAxes& axes)
    : transposed(std::abs(axes.along[1]) + std::abs(axes.down[0]) >
                 std::abs(axes.along[0]) + std::abs(axes.down[1])),
      rows_back(axes.down[transposed ? 0 : 1] < 0),
      columns_back(axes.along[transposed ? 1 : 0] < 0) {}

}  // namespace tetrakis::tools
