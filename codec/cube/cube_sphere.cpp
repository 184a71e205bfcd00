// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/cube_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/portable_math.hpp"

namespace tetrakis::inline cube {

namespace {

struct Axis {
  int x, y, z;

  double along(const SpherePoint& d) const { return x * d.x + y * d.y + z * d.z; }
};

/// Of a face of the cube from -1 to 1: its middle, and what is east and south on it as seen from
/// outside.
struct Frame {
  Axis middle, east, south;
};

constexpr std::array<Frame, kCubePatches> kFrames = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                                      {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                                      {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                                      {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                                      {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                                      {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}}};

constexpr double kDegree = std::numbers::pi / 180;

/// Of |x| <= 1, to some units of the last place; the same bits everywhere, in a hundredth of the
/// time of portable::atan(), because there are millions of samples. S. L. Moshier, "Methods and
/// Programs for Mathematical Functions", 1989.
double arctangent(double x) {
  const double size = std::abs(x);
  const bool is_large = size > 0.66;
  const double t = is_large ? (size - 1) / (size + 1) : size, z = t * t;
  const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                     7.500855792314704667340e1) *
                        z -
                    1.228866684490136173410e2) *
                       z -
                   6.485021904942025371773e1;
  const double q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                     4.328810604912902668951e2) *
                        z +
                    4.853903996359136964868e2) *
                       z +
                   1.945506571482613964425e2;
  return std::copysign((is_large ? std::numbers::pi / 4 : 0) + (t + t * z * p / q), x);
}

/// Of a vector in a plane, from -180 to 180.
double degreesOf(double x, double y) {
  if (std::abs(y) <= std::abs(x)) {
    if (x == 0) return 0;
    const double within = arctangent(y / x) / kDegree;
    return x > 0 ? within : within + (y < 0 ? -180 : 180);
  }
  return (y < 0 ? -90 : 90) - arctangent(x / y) / kDegree;
}

}  // namespace

Forest cubeForest(int depth) {
  return Forest(depth, std::vector<uint32_t>(kCubeSides.begin(), kCubeSides.end()));
}

double offMiddle(double x) {
  return portable::tan((x - 0.5) * (std::numbers::pi / 2));
}

double placeAt(double off_middle) {
  return std::clamp(arctangent(off_middle) * (2 / std::numbers::pi) + 0.5, 0.0, 1.0);
}

std::vector<float> patchAreas(uint32_t side) {
  std::vector<double> squares;  // of offMiddle()
  for (uint32_t i = 0; i < side; ++i) {
    const double off = offMiddle(static_cast<double>(i) / (side - 1));
    squares.push_back(off * off);
  }
  std::vector<float> areas;
  areas.reserve(size_t{side} * side);
  for (const double y : squares) {
    for (const double x : squares) {
      const double length = 1 + x + y;
      areas.push_back(static_cast<float>((1 + x) * (1 + y) / (length * std::sqrt(length))));
    }
  }
  return areas;
}

SpherePoint pointOf(uint32_t patch, double off_x, double off_y) {
  const auto& [middle, east, south] = kFrames[patch];
  const double length = std::sqrt(1 + off_x * off_x + off_y * off_y);
  return {(middle.x + off_x * east.x + off_y * south.x) / length,
          (middle.y + off_x * east.y + off_y * south.y) / length,
          (middle.z + off_x * east.z + off_y * south.z) / length};
}

CubePlace cubePlaceOf(const SpherePoint& point) {
  uint32_t patch = 0;
  for (uint32_t other = 1; other < kCubePatches; ++other) {
    if (kFrames[other].middle.along(point) > kFrames[patch].middle.along(point)) patch = other;
  }
  const auto& [middle, east, south] = kFrames[patch];
  const double ahead = middle.along(point);
  return {patch, placeAt(east.along(point) / ahead), placeAt(south.along(point) / ahead)};
}

SpherePoint pointOf(const Geographic& place) {
  const double off_axis = cosineOfDegrees(place.latitude);
  return {off_axis * cosineOfDegrees(place.longitude), off_axis * sineOfDegrees(place.longitude),
          sineOfDegrees(place.latitude)};
}

Geographic geographicOf(const SpherePoint& point) {
  const auto& [x, y, z] = point;
  return {degreesOf(x, y), degreesOf(std::sqrt(x * x + y * y), z)};
}

double sineOfDegrees(double degrees) {
  double within = std::remainder(degrees, 360);
  if (std::abs(within) > 90) within = std::copysign(180, within) - within;
  return portable::sin(within * kDegree);
}

double cosineOfDegrees(double degrees) {
  return sineOfDegrees(90 - std::abs(std::remainder(degrees, 360)));
}

}  // namespace tetrakis::inline cube
