// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/globe/globe_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline globe {
namespace {

constexpr double kPole = 90;
constexpr double kRowSlack = 1e-6;     // of a row: files write its height with few digits
constexpr double kDegreeSlack = 1e-9;  // a tenth of a millimetre on the Earth

/// Of an angle in degrees; exact at multiples of 90.
struct Direction {
  double cosine, sine;

  explicit Direction(double degrees) {
    const double quarters = std::round(degrees / 90);
    const double rest = (degrees - 90 * quarters) * (std::numbers::pi / 180);
    cosine = portable::cos(rest);
    sine = portable::sin(rest);
    const auto turns = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
    for (int turn = 0; turn < turns; ++turn) cosine = -std::exchange(sine, cosine);
  }
};

}  // namespace

std::array<double, 3> above(const Spheroid& spheroid, const SpherePoint& up, double height) {
  // N, the radius of curvature across the meridian, and its part along the axis.
  const double a = spheroid.equatorial, b = spheroid.polar;
  const double across = a * std::sqrt(up.x * up.x + up.y * up.y), along = b * up.z;
  const double root = std::sqrt(across * across + along * along);
  const double radius = a * a / root + height;
  return {radius * up.x, radius * up.y, (b * b / root + height) * up.z};
}

bool GlobePlaces::onGlobe() const {
  const double last = latitudes_.at(latitudes_.count - 1.0);
  const double most = kPole + kRowSlack * std::abs(latitudes_.step);
  return std::abs(latitudes_.first) <= most && std::abs(last) <= most;
}

std::optional<double> GlobePlaces::poleBeyond(double row, double outwards) const {
  const double pole = latitudes_.step * outwards > 0 ? kPole : -kPole;
  const double beyond = (pole - latitudes_.at(row)) / (latitudes_.step * outwards);
  if (std::abs(beyond) <= kRowSlack) return row;
  if (beyond > 1 + kRowSlack) return std::nullopt;
  return row + outwards * beyond;
}

RoundGrid GlobePlaces::grid() const {
  return {longitudes_.count, latitudes_.count, poleBeyond(0, -1),
          poleBeyond(latitudes_.count - 1.0, 1)};
}

/// A row on a pole covers what lies within half a row of it.
std::vector<float> GlobePlaces::rowAreas() const {
  const double quarter = std::abs(latitudes_.step) / 4;
  std::vector<float> areas;
  for (uint32_t row = 0; row < latitudes_.count; ++row) {
    const double most = kPole - quarter, latitude = latitudes_.at(row);
    areas.push_back(static_cast<float>(Direction(std::clamp(latitude, -most, most)).cosine));
  }
  return areas;
}

std::array<double, 3> GlobePlaces::at(const GridPlace& place, double height) const {
  const double column = place.column < longitudes_.count ? place.column : 0;
  double latitude = std::clamp(latitudes_.at(place.row), -kPole, kPole);
  if (std::abs(latitude) > kPole - kDegreeSlack) latitude = std::copysign(kPole, latitude);
  const Direction east(longitudes_.at(column)), north(latitude);
  return above(spheroid_, {north.cosine * east.cosine, north.cosine * east.sine, north.sine},
               height);
}

CubeSpheroid::CubeSpheroid(const Forest& forest, const Spheroid& spheroid)
    : forest_(forest), spheroid_(spheroid) {
  const uint32_t side = forest.side();
  for (uint32_t i = 0; i < side; ++i)
    off_middle_.push_back(offMiddle(static_cast<double>(i) / (side - 1)));
}

std::array<double, 3> CubeSpheroid::at(uint32_t sample, double height) const {
  const uint32_t side = forest_.side();
  const uint32_t patch = sample / (side * side), y = sample / side % side, x = sample % side;
  const Forest::Place owner = forest_.owner(side - 1, {patch, x, y});
  const SpherePoint up = pointOf(owner.patch, off_middle_[static_cast<size_t>(owner.x)],
                                 off_middle_[static_cast<size_t>(owner.y)]);
  return above(spheroid_, up, height);
}

}  // namespace tetrakis::inline globe
