// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_level_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

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

}  // namespace tetrakis::inline colour
