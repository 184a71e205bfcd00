// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_fit.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace tetrakis::inline colour {

namespace {

/// The energy of the shears of a level, at most: coefficients stay near their size. A larger number
/// allows turns that save more bits, and wider coefficients.
constexpr double kMostEnergy = 4;
/// Bits of a level's shears in the header. A larger number turns fewer levels.
constexpr double kBitsPerSet = 50;

double bitsOf(const ColourTransform& transform, int level, const ColourDetails& details,
              double step) {
  const Matrix3 matrix = colourMatrix(transform, level);
  const std::array<double, 3> energies = planeEnergies(transform, level);
  double bits = 0;
  for (size_t i = 0; i < 3; ++i)
    bits += bitsAlong(matrix[i], details, step / std::sqrt(energies[i]));
  return bits;
}

double determinant(const Matrix3& m) {
  double sum = 0;
  for (size_t j = 0; j < 3; ++j) {
    const size_t k = (j + 1) % 3, l = (j + 2) % 3;
    sum += m[0][j] * (m[1][k] * m[2][l] - m[1][l] * m[2][k]);
  }
  return sum;
}

/// The rows of a in coordinates of the rows of m (Cramer's rule).
Matrix3 inCoordinatesOf(const Matrix3& m, const Matrix3& a) {
  Matrix3 out{};
  const double whole = determinant(m);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      Matrix3 replaced = m;
      replaced[j] = a[i];
      out[i][j] = determinant(replaced) / whole;
    }
  }
  return out;
}

/// Shears that point c0 along w, c1 along u and c2 along v; infinite or NaN where there are none:
///   c1 = e1 + s0 e2 + s1 e0 = u / u1,  c2 = e2 + s2 c1 + s3 e0 ~ v,  c0 = e0 + s4 c1 + s5 c2 ~ w.
std::array<double, 6> shearsTowards(const std::array<double, 3>& w, const std::array<double, 3>& u,
                                    const std::array<double, 3>& v) {
  const double s0 = u[2] / u[1], s1 = u[0] / u[1];
  const double length = v[2] - v[1] * s0;
  const double s2 = v[1] / length, s3 = v[0] / length - s2 * s1;
  const double c2 = w[2] - w[1] * s0, c1 = w[1] - c2 * s2;
  const double e0 = w[0] - c1 * s1 - c2 * (s3 + s2 * s1);
  return {s0, s1, s2, s3, c1 / e0, c2 / e0};
}

/// Turns the colour planes of a transform into the rows of a rotation, row 0 first.
Shears levelShears(const Matrix3& matrix, const Matrix3& rotation) {
  const Matrix3 rows = inCoordinatesOf(matrix, rotation);
  Shears best{};
  double least = kMostEnergy;
  for (size_t second : {1u, 2u}) {
    const auto shears = shearsTowards(rows[0], rows[second], rows[3 - second]);
    double energy = 0;
    for (double s : shears) energy += s * s;
    if (!(energy < least)) continue;
    least = energy;
    std::transform(shears.begin(), shears.end(), best.begin(), [](double s) {
      return static_cast<int16_t>(std::lround(s * (1 << kShearFractionBits)));
    });
  }
  return best;
}

double bitsOf(const ColourTransform& transform, std::span<const ColourDetails> details,
              double step) {
  double bits = kBitsPerSet * static_cast<double>(transform.level_shears.size());
  for (size_t i = 0; i < details.size(); ++i)
    bits += bitsOf(transform, static_cast<int>(i + 1), details[i], step);
  return bits;
}

}  // namespace

TurnedLevels turnLevels(const ColourTransform& transform, const ColourAxes& axes, double step) {
  assert(transform.level_shears.empty());
  const Matrix3 matrix = colourMatrix(transform);
  ColourTransform turned = transform;
  TurnedLevels best{transform, bitsOf(transform, axes.details, step)};
  const size_t levels = std::min(axes.levels.size(), 1 + ColourTransform::kMostLevelShears);
  for (size_t i = 1; i < levels; ++i) {
    turned.level_shears.push_back(levelShears(matrix, axes.levels[i]));
    const double bits = bitsOf(turned, axes.details, step);
    if (bits < best.bits) best = {turned, bits};
  }
  return best;
}

namespace {

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

ColourTransform rotated(ColourTransform transform, const Matrix3& rotation) {
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
  return transform;
}

ColourTransform centred(std::span<const int32_t* const> channels, size_t count) {
  ColourTransform transform;
  for (size_t c = 0; c < channels.size(); ++c) {
    const int64_t sum = std::accumulate(channels[c], channels[c] + count, int64_t{0});
    const auto texels = static_cast<int64_t>(count);
    transform.centre[c] = static_cast<uint16_t>((sum + texels / 2) / texels);
  }
  return transform;
}

ColourTransform fitColour(std::span<const int32_t* const> channels, Extent extent) {
  const ColourTransform none = centred(channels, extent.samples());
  if (channels.size() < 3) return none;
  const ColourAxes axes = fitAxes(channels, extent, Purpose::kLossy);
  const ColourTransform overall = rotated(none, axes.overall);
  if (axes.details.empty()) return overall;
  const double step = typicalStep(axes.details);
  const TurnedLevels from_overall = turnLevels(overall, axes, step);
  const TurnedLevels from_finest = turnLevels(rotated(none, axes.levels.front()), axes, step);
  return from_finest.bits < from_overall.bits ? from_finest.transform : from_overall.transform;
}

}  // namespace tetrakis::inline colour
