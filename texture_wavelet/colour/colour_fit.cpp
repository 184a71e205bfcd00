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
