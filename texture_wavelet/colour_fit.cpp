// SPDX-License-Identifier: Apache-2.0
// Rotation of the colour axes that needs the fewest bits.
//
// A wavelet coefficient c coded with a step T costs about log2(1 + |c| / T) bits. The sum of that
// over Haar details ranks rotations as a coder does; the variances of a KLT do not, because a few
// strong edges rule them. Starting from the fixed rotation to (sum, red - blue, green - magenta),
// plane rotations walk to the minimum. T is the mean of |c|, or 1 where every bit will be coded;
// with a half or a quarter of the mean the bytes change by 0.1 %.
#include "texture_wavelet/colour_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "texture_wavelet/colour_level_fit.hpp"

namespace tetrakis {
namespace {

Matrix3 fixedRotation() {
  const double s3 = std::sqrt(1.0 / 3), s2 = std::sqrt(0.5), s6 = std::sqrt(1.0 / 6);
  return {{{s3, s3, s3}, {s2, 0, -s2}, {-s6, 2 * s6, -s6}}};
}

void rotateRows(Matrix3& rotation, size_t p, size_t q, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (size_t j = 0; j < 3; ++j) {
    const double a = rotation[p][j], b = rotation[q][j];
    rotation[p][j] = c * a + s * b;
    rotation[q][j] = c * b - s * a;
  }
}

/// Rotates rows p and q by +-angle for as long as that saves bits. Returns whether it did.
bool descend(Matrix3& rotation, std::array<double, 3>& rates, size_t p, size_t q, double angle,
             const ColourDetails& details, double step) {
  bool moved = false;
  for (double turn : {angle, -angle}) {
    for (;;) {
      Matrix3 turned = rotation;
      rotateRows(turned, p, q, turn);
      const double rate_p = bitsAlong(turned[p], details, step);
      const double rate_q = bitsAlong(turned[q], details, step);
      if (!(rate_p + rate_q < (rates[p] + rates[q]) * (1 - 1e-9))) break;
      rotation = turned;
      rates[p] = rate_p;
      rates[q] = rate_q;
      moved = true;
    }
  }
  return moved;
}

/// Walks from a rotation to the nearest that needs the fewest bits.
Matrix3 cheapestRotation(Matrix3 rotation, const ColourDetails& details, Purpose purpose) {
  constexpr double kFirstAngle = 0.2, kLastAngle = 0.005;
  const double step = purpose == Purpose::kLossless ? 1 : meanMagnitude(details);
  if (step == 0) return rotation;
  std::array<double, 3> rates{};
  for (size_t i = 0; i < 3; ++i) rates[i] = bitsAlong(rotation[i], details, step);
  for (double angle = kFirstAngle; angle > kLastAngle; angle /= 2) {
    for (bool moved = true; moved;) {
      moved = false;
      for (auto [p, q] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 2u}}) {
        moved |= descend(rotation, rates, p, q, angle, details, step);
      }
    }
  }
  return rotation;
}

/// Moves the row of the greatest energy to the front.
void putLumaFirst(Matrix3& rotation, const ColourDetails& details) {
  std::array<double, 3> energies{};
  for (const Colour& d : details.samples) {
    for (size_t i = 0; i < 3; ++i)
      energies[i] +=
          std::pow(rotation[i][0] * d[0] + rotation[i][1] * d[1] + rotation[i][2] * d[2], 2);
  }
  const auto strongest = std::max_element(energies.begin(), energies.end()) - energies.begin();
  std::swap(rotation[0], rotation[static_cast<size_t>(strongest)]);
}

ColourDetails pooled(std::span<const ColourDetails> details) {
  ColourDetails all;
  for (const ColourDetails& scale : details)
    all.samples.insert(all.samples.end(), scale.samples.begin(), scale.samples.end());
  return all;
}

/// One for each level. Each starts from that of the finer level, so that components keep their
/// places.
std::vector<Matrix3> fitRotations(std::span<const ColourDetails> details, Purpose purpose) {
  std::vector<Matrix3> rotations;
  for (const ColourDetails& scale : details) {
    if (rotations.empty()) {
      rotations.push_back(cheapestRotation(fixedRotation(), scale, purpose));
      putLumaFirst(rotations.front(), scale);
    } else {
      rotations.push_back(cheapestRotation(rotations.back(), scale, purpose));
    }
  }
  return rotations;
}

/// A choice of shears for a rotation: the order of the channels, and whether c1 is row 2.
struct Arrangement {
  std::array<uint8_t, 3> order;
  bool exchanged;
};

/// The shears that give the planes c0, c1, c2 the directions of the rows of a rotation; infinite or
/// NaN where there are none. With the columns in order and unit vectors e, the planes are
///   c1 = e1 + s0 e2 + s1 e0 = u / u1,   c2 = e2 + s2 c1 + s3 e0 = v / (v2 - v1 s0),
///   c0 = e0 + s4 c1 + s5 c2, at right angles to u and v.
std::array<double, 6> shearsOf(const Matrix3& rotation, const Arrangement& arrangement) {
  const auto [i0, i1, i2] = arrangement.order;
  const auto& u = rotation[arrangement.exchanged ? 2 : 1];
  const auto& v = rotation[arrangement.exchanged ? 1 : 2];
  const double s0 = u[i2] / u[i1], s1 = u[i0] / u[i1];
  const double length = v[i2] - v[i1] * s0;
  const double s2 = v[i1] / length, s3 = v[i0] / length - s2 * s1;
  return {s0, s1, s2, s3, -u[i0] * u[i1], -v[i0] * length};
}

int16_t quantised(double shear) {
  return static_cast<int16_t>(std::lround(shear * (1 << kShearFractionBits)));
}

}  // namespace

void setRotation(ColourTransform& transform, const Matrix3& rotation) {
  // Small shears add little rounding noise. Over all rotations the smallest are at most 1.7
  // (square root of the sum of squares), which keeps 16-bit samples clear of overflow.
  double least = std::numeric_limits<double>::infinity();
  for (uint8_t order = 0; order < kChannelOrders.size(); ++order) {
    for (bool exchanged : {false, true}) {
      const auto shears = shearsOf(rotation, {kChannelOrders[order], exchanged});
      double energy = 0;
      for (double s : shears) energy += s * s;
      if (!(energy < least)) continue;
      least = energy;
      transform.order = order;
      std::transform(shears.begin(), shears.end(), transform.shears.begin(), quantised);
    }
  }
}

ColourAxes fitAxes(std::span<const int32_t* const> planes, uint32_t width, uint32_t height,
                   Purpose purpose) {
  ColourAxes axes;
  axes.details = sampleDetails(planes, width, height);
  axes.overall = fixedRotation();
  if (axes.details.empty()) return axes;
  const ColourDetails all = pooled(axes.details);
  axes.overall = cheapestRotation(fixedRotation(), all, purpose);
  putLumaFirst(axes.overall, all);
  axes.levels = fitRotations(axes.details, purpose);
  return axes;
}

ColourTransform centred(std::span<const int32_t* const> planes, size_t count) {
  ColourTransform transform;
  for (size_t p = 0; p < planes.size(); ++p) {
    const int64_t sum = std::accumulate(planes[p], planes[p] + count, int64_t{0});
    const auto pixels = static_cast<int64_t>(count);
    transform.centre[p] = static_cast<uint16_t>((sum + pixels / 2) / pixels);
  }
  return transform;
}

ColourTransform fitColour(std::span<const int32_t* const> planes, uint32_t width, uint32_t height) {
  ColourTransform best = centred(planes, size_t{width} * height);
  if (planes.size() < 3) return best;
  const ColourAxes axes = fitAxes(planes, width, height, Purpose::kLossy);
  setRotation(best, axes.overall);
  if (axes.details.empty()) return best;
  const double step = typicalStep(axes.details);
  double least = turnLevels(best, axes, step);
  ColourTransform other = best;
  other.level_shears.clear();
  setRotation(other, axes.levels.front());
  return turnLevels(other, axes, step) < least ? other : best;
}

}  // namespace tetrakis
