// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "texture_wavelet/colour/colour_axes.hpp"
#include "texture_wavelet/colour/colour_level_fit.hpp"

namespace tetrakis::inline colour {
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

ColourTransform centred(std::span<const int32_t* const> planes, size_t count) {
  ColourTransform transform;
  for (size_t p = 0; p < planes.size(); ++p) {
    const int64_t sum = std::accumulate(planes[p], planes[p] + count, int64_t{0});
    const auto pixels = static_cast<int64_t>(count);
    transform.centre[p] = static_cast<uint16_t>((sum + pixels / 2) / pixels);
  }
  return transform;
}

ColourTransform fitColour(std::span<const int32_t* const> planes, Extent extent) {
  ColourTransform best = centred(planes, extent.samples());
  if (planes.size() < 3) return best;
  const ColourAxes axes = fitAxes(planes, extent, Purpose::kLossy);
  setRotation(best, axes.overall);
  if (axes.details.empty()) return best;
  const double step = typicalStep(axes.details);
  double least = turnLevels(best, axes, step);
  ColourTransform other = best;
  other.level_shears.clear();
  setRotation(other, axes.levels.front());
  return turnLevels(other, axes, step) < least ? other : best;
}

}  // namespace tetrakis::inline colour
