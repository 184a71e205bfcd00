// SPDX-License-Identifier: Apache-2.0
// costOf() estimates the bits that the coefficients of a plane take when they are coded with a
// step: the entropy of their numbers of bits, given those of the neighbours that come before, and
// the bits below the highest. Encoders compare two transforms of one plane by it.
#pragma once

#include <cstdint>
#include <span>

#include "codec/wavelet/band_plan.hpp"

namespace tetrakis::inline choice {

struct PlaneCost {
  double bits = 0;
  double squares = 0;  ///< squared error of the plane

  /// One figure for both, in bits: the error that a step leaves, at the exchange rate of its
  /// bit-plane. A bit that refines a coefficient takes step^2 / 4 of squared error off, and one
  /// that makes it significant about 0.4 step^2. step 0: nothing is left.
  double joint(double step) const;
};

/// coefficients: laid out as the pyramid of the layout says. step: of the plane; 0: all of their
/// bits. Those of samples that do not exist or are held cost nothing.
PlaneCost costOf(const PlaneLayout& layout, std::span<const int32_t> coefficients, double step);

}  // namespace tetrakis::inline choice
