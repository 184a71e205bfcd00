// SPDX-License-Identifier: Apache-2.0
// solidNoise() is the gradient noise of noise.hpp in space (Perlin, "Improving noise", 2002).
#pragma once

#include <array>

#include "apps/tools/synth/noise.hpp"
#include "apps/tools/synth/surfaces/shape.hpp"

namespace tetrakis::tools::synth {

/// Dot product with one of the twelve directions to the middles of a cube's edges, four of them
/// twice.
inline double solidGradient(uint64_t h, const Spot& p) {
  constexpr double kSigns[2] = {1, -1};
  const size_t side = h >> 60;
  const size_t left_out = side < 12 ? side / 4 : side % 3;
  const double first = p[(left_out + 1) % 3], second = p[(left_out + 2) % 3];
  return kSigns[side & 1] * first + kSigns[side >> 1 & 1] * second;
}

/// Within -1 and 1, zero mean, features about one unit wide.
inline double solidNoise(uint64_t seed, const Spot& p) {
  std::array<int64_t, 3> cell{};
  Spot inside{}, share{};
  for (size_t axis = 0; axis < 3; ++axis) {
    cell[axis] = floorOf(p[axis]);
    const double t = inside[axis] = p[axis] - static_cast<double>(cell[axis]);
    share[axis] = t * t * t * (t * (6 * t - 15) + 10);
  }
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> step{corner & 1, corner >> 1 & 1, corner >> 2};
    double weight = 1;
    Spot from{};
    for (size_t axis = 0; axis < 3; ++axis) {
      weight *= step[axis] == 1 ? share[axis] : 1 - share[axis];
      from[axis] = inside[axis] - step[axis];
    }
    const uint64_t plane = hash(seed, cell[2] + step[2], 0);
    value += weight * solidGradient(hash(plane, cell[0] + step[0], cell[1] + step[1]), from);
  }
  return value;
}

/// Octaves of twice the frequency and half the amplitude each: within -1 and 1.
inline double solidFractal(uint64_t seed, Spot p, int octaves) {
  double sum = 0, amplitude = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * solidNoise(seed + static_cast<uint64_t>(i), p);
    p = {2 * (0.8 * p[0] - 0.6 * p[1]), 2 * (0.6 * p[0] + 0.8 * p[1]), 2 * p[2] + 0.5};
    amplitude /= 2;
  }
  return sum;
}

}  // namespace tetrakis::tools::synth
