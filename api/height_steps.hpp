// SPDX-License-Identifier: Apache-2.0
// Heights of any sample type to integer steps and back: sample = base + q * step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/header.hpp"
#include "bitstream/status.hpp"

namespace tetrakis {

struct HeightSteps {
  std::vector<int32_t> steps;  ///< |q| <= 2^25, centred on 0
  double base = 0, step = 1;
  bool exact = false;  ///< every sample comes back bit for bit
  int range_bits = 0;  ///< the steps span less than 2^range_bits
};

/// Chooses base and step. wanted_step > 0 is taken as it is (in sample units). Otherwise integers
/// get the greatest common divisor of their differences, floats the coarsest of 1, 0.1, 0.01, 0.001
/// or a power of two that restores every sample; where no step does that within 2^26 steps, a power
/// of two near range / 2^20, but not above finest_useful (> 0). TKS_USAGE: a sample is NaN or
/// infinite, or the step needs more than 2^26 steps.
Result<HeightSteps> toSteps(const tks_heights& heights, double wanted_step, double finest_useful);

/// Writes count samples of header.sample. steps as decoded; integers saturate at their type's
/// range.
void fromSteps(const std::vector<int32_t>& steps, const GeometryHeader& header, void* out);

}  // namespace tetrakis
