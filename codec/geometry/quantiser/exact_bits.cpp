// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/quantiser/exact_bits.hpp"

#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::inline quantiser {

double bitsOfSteps(const tks_heights& heights, const HeightSteps& steps) {
  return losslessBits({steps.steps, {heights.width, heights.height}, steps.valid},
                      steps.range_bits);
}

double exactBits(const tks_heights& heights, const HeightSteps& steps) {
  const double bits = bitsOfSteps(heights, steps);
  if (steps.exact) return bits;
  Exceptions exceptions;
  for (const int32_t correction : sampleCorrections(heights, steps)) {
    if (correction != 0) exceptions.add(static_cast<uint32_t>(correction), 1);
  }
  return bits + exceptions.bits(steps.validCount());
}

}  // namespace tetrakis::inline quantiser
