// SPDX-License-Identifier: Apache-2.0
// The functions here estimate the number of bits that heights take to the last bit. Encoder only.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// Corrections of samples: how many are not 0, and the bits that their magnitudes take.
struct Exceptions {
  size_t count = 0;
  double magnitude_bits = 0;

  void add(uint32_t correction, size_t samples) {
    const auto signed_one = static_cast<double>(static_cast<int32_t>(correction));
    count += samples;
    magnitude_bits += static_cast<double>(samples) * (1 + portable::log2(1 + std::abs(signed_one)));
  }
  /// The bits of the corrections that are not 0, and of their places among all samples.
  double bits(size_t samples) const {
    const double share = static_cast<double>(count) / static_cast<double>(samples);
    if (count == 0 || count == samples) return magnitude_bits;
    const double entropy = -share * portable::log2(share) - (1 - share) * portable::log2(1 - share);
    return magnitude_bits + static_cast<double>(samples) * entropy;
  }
};

/// The bits of the coefficients of steps, without the corrections that restore samples behind them.
double bitsOfSteps(const tks_heights& heights, const HeightSteps& steps);

/// The bits of the steps, multiples of `step`, and of the corrections that restore the samples.
double exactBits(const tks_heights& heights, const HeightSteps& steps);

}  // namespace tetrakis::inline quantiser
