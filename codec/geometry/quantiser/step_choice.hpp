// SPDX-License-Identifier: Apache-2.0
// toSteps() turns heights of any sample type into integer steps, sample = base + q * step: it finds
// the base and the step of all samples. A few samples off that grid (a negative zero, one
// interpolated height, an undeclared void of 3.4e38) are left to corrections, so that they do not
// make every step finer.
#pragma once

#include "base/status.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// The demands of the target on the steps that are chosen.
struct StepNeeds {
  double given = 0;       ///< > 0: the step itself, in sample units; nothing is chosen
  bool lossless = false;  ///< corrections will restore the samples
  bool table = false;     ///< for `lossless`: a table of values may take the place of multiples
  double error = 0;       ///< > 0: largest error wanted, in sample units
  /// A few samples may be lost that are so far from the others that no steps show both; for
  /// `lossless` corrections restore them.
  bool leave_outliers = false;
};

/// Chooses base and step. Integers get the greatest common divisor of their differences, doubled
/// until 2^26 steps suffice; floats the coarsest of 1, 0.1, 0.01, 0.001 or a power of two that
/// restores the value of every sample, or of all but one in 256 where these may be exceptions.
/// Where no step does that within 2^26 steps: for lossless sixteen times the spacing of the largest
/// floats (corrections do the rest); else a power of two near range / 2^20, but not above error /
/// 64 unless that takes more than 2^26 steps. TKS_USAGE: a sample is infinite, or the given step
/// needs more than 2^26 steps.
Result<HeightSteps> toSteps(const tks_heights& heights, const StepNeeds& needs);

}  // namespace tetrakis::inline quantiser
