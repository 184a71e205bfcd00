// SPDX-License-Identifier: Apache-2.0
// How much an error in a wavelet coefficient hurts: the L2 norm of its synthesis function.
#pragma once

#include "texture_wavelet/wavelet.hpp"

namespace tetrakis {

/// Steps of normLog2 in a factor of two.
inline constexpr int kNormSteps = 16;

/// 16 log2 of the band's norm, rounded. Normative: the order of the bit-planes depends on it.
int normLog2(const Subband& band);

/// The band's norm to 0.2 %, for rate-distortion weights: an error e in one coefficient changes the
/// squared error of the plane by e^2 * norm^2.
double normOf(const Subband& band);

}  // namespace tetrakis
