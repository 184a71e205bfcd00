// SPDX-License-Identifier: Apache-2.0
// solidNoise() is the gradient noise of noise.hpp in space (Perlin, "Improving noise", 2002).
#pragma once

#include "apps/tools/synth/noise.hpp"
#include "apps/tools/synth/surfaces/shape.hpp"

namespace tetrakis::tools::synth {

/// Within -1 and 1, zero mean, features about one unit wide.
double solidNoise(uint64_t seed, const Spot& p);

/// Octaves of twice the frequency and half the amplitude each: within -1 and 1.
double solidFractal(uint64_t seed, Spot p, int octaves);

}  // namespace tetrakis::tools::synth
