// SPDX-License-Identifier: Apache-2.0
// Rotation of the colour axes that needs the fewest bits.
//
// A wavelet coefficient c coded with a step T costs about log2(1 + |c| / T) bits. The sum of that
// over Haar details ranks rotations as a coder does; the variances of a KLT do not, because a few
// strong edges rule them. Starting from the fixed rotation to (sum, red - blue, green - magenta),
// plane rotations walk to the minimum. T is the mean of |c|, or 1 where every bit will be coded;
// with a half or a quarter of the mean the bytes change by 0.1 %.
#include "texture_wavelet/colour/colour_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline colour {
namespace {

/// Angles, in radians, by which axes are turned at first and in the end, each half of the one
/// before. A wider range finds better axes, and takes time.
constexpr double kFirstAngle = 0.2, kLastAngle = 0.005;
constexpr double kSlack = 1e-9;  // a smaller gain is one of rounding

Matrix3 fixedRotation() {
  const double s3 = std::sqrt(1.0 / 3), s2 = std::sqrt(0.5), s6 = std::sqrt(1.0 / 6);
  return {{{s3, s3, s3}, {s2, 0, -s2}, {-s6, 2 * s6, -s6}}};
}

void rotateRows(Matrix3& rotation, size_t p, size_t q, double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  for (size_t j = 0; j < 3; ++j) {
    const double a = rotation[p][j], b = rotation[q][j];
    rotation[p][j] = c * a + s * b;
    rotation[q][j] = c * b - s * a;
  }
}

/// The estimated bits of all details along an axis.
struct AxisRate {
  const ColourDetails& details;
  double step;

  double operator()(const std::array<double, 3>& axis) const {
    return bitsAlong(axis, details, step);
  }
};

/// Rotates two rows by +-angle for as long as that saves bits. Returns whether it did.
bool descend(Matrix3& rotation, std::array<double, 3>& rates, std::pair<size_t, size_t> rows,
             double angle, const AxisRate& rate) {
  const auto [p, q] = rows;
  bool moved = false;
  for (double turn : {angle, -angle}) {
    for (;;) {
      Matrix3 turned = rotation;
      rotateRows(turned, p, q, turn);
      const double rate_p = rate(turned[p]);
      const double rate_q = rate(turned[q]);
      if (!(rate_p + rate_q < (rates[p] + rates[q]) * (1 - kSlack))) break;
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
  const double step = purpose == Purpose::kLossless ? 1 : meanMagnitude(details);
  if (step == 0) return rotation;
  const AxisRate rate{details, step};
  std::array<double, 3> rates{};
  for (size_t i = 0; i < 3; ++i) rates[i] = rate(rotation[i]);
  constexpr std::array<std::pair<size_t, size_t>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};
  for (double angle = kFirstAngle; angle > kLastAngle; angle /= 2) {
    // Any two pairs have a row in common: what moves one may be worth moving the others.
    for (size_t pair = 0, still = 0; still < kPairs.size(); pair = (pair + 1) % kPairs.size())
      still = descend(rotation, rates, kPairs[pair], angle, rate) ? 0 : still + 1;
  }
  return rotation;
}

/// With the row of the greatest energy at the front.
Matrix3 lumaFirst(Matrix3 rotation, const ColourDetails& details) {
  std::array<double, 3> energies{};
  const auto& [first, second, third] = details.channels;
  for (size_t k = 0; k < details.count(); ++k) {
    for (size_t i = 0; i < 3; ++i) {
      const double along =
          rotation[i][0] * first[k] + rotation[i][1] * second[k] + rotation[i][2] * third[k];
      energies[i] += along * along;
    }
  }
  const auto strongest = std::max_element(energies.begin(), energies.end()) - energies.begin();
  std::swap(rotation[0], rotation[static_cast<size_t>(strongest)]);
  return rotation;
}

ColourDetails pooled(std::span<const ColourDetails> details) {
  ColourDetails all;
  for (const ColourDetails& scale : details) {
    for (size_t k = 0; k < all.channels.size(); ++k)
      all.channels[k].insert(all.channels[k].end(), scale.channels[k].begin(),
                             scale.channels[k].end());
  }
  return all;
}

/// One for each level. Each starts from that of the finer level, so that colour planes keep
/// their places.
std::vector<Matrix3> fitRotations(std::span<const ColourDetails> details, Purpose purpose) {
  std::vector<Matrix3> rotations;
  for (const ColourDetails& scale : details) {
    const Matrix3 cheapest =
        cheapestRotation(rotations.empty() ? fixedRotation() : rotations.back(), scale, purpose);
    rotations.push_back(rotations.empty() ? lumaFirst(cheapest, scale) : cheapest);
  }
  return rotations;
}

}  // namespace

ColourAxes fitAxes(std::span<const int32_t* const> channels, Extent extent, Purpose purpose) {
  std::vector<ColourDetails> details = sampleDetails(channels, extent);
  if (details.empty()) return {{}, fixedRotation(), {}};
  const ColourDetails all = pooled(details);
  const Matrix3 overall = lumaFirst(cheapestRotation(fixedRotation(), all, purpose), all);
  std::vector<Matrix3> levels = fitRotations(details, purpose);
  return {std::move(details), overall, std::move(levels)};
}

}  // namespace tetrakis::inline colour
