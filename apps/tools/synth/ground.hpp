// SPDX-License-Identifier: Apache-2.0
// groundAt() tells which ground lies or grows at a place, and its colour from the air.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/synth/noise.hpp"

namespace tetrakis::tools::synth {

/// RGB, 0 to 255.
using Colour = std::array<double, 3>;

inline Colour mix(const Colour& a, const Colour& b, double t) {
  return {mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t)};
}

inline Colour times(const Colour& a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}

/// All that decides about the ground at one place.
struct Site {
  Point metres;                        ///< from the north-western corner
  double altitude = 0;                 ///< share of the terrain's relief
  double height = 0;                   ///< metres above the sea
  double slope = 0;                    ///< tangent
  double hollow = 0;                   ///< metres below the mean of the surroundings
  double wetness = 0;                  ///< log2 of the cells that drain through
  double river = 0;                    ///< metres to the nearest bank, negative in the water
  double land = 1;                     ///< share of land around: falls off the shore
  double lake = 0, sea = 0, roof = 0;  ///< share of the texel
};

/// Reflected colour, and how rough the surface looks under slanting light.
struct Ground {
  Colour colour{};
  double roughness = 0;
};

Ground groundAt(uint64_t seed, const Site& site);

}  // namespace tetrakis::tools::synth
