// SPDX-License-Identifier: Apache-2.0
// costOf() estimates the bits that the coefficients of a plane take without coding them, and
// ComparedSteps tells by such costs which of two ways to code a plane takes fewer. Encoder only.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/wavelet/band_plan.hpp"

namespace tetrakis::inline choice {

// costOf() estimates the bits that the coefficients of a plane take when they are coded with a
// step: the entropy of their numbers of bits, given those of the neighbours that come before, and
// the bits below the highest. Encoders compare two transforms of one plane by it.

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

// ComparedSteps compares two ways to code one plane, at the step of the target and at coarser
// steps, because every prefix of a stream is a stream.

/// What a plane costs that is coded one way, with a step.
using CostAtStep = std::function<PlaneCost(double)>;

/// Steps at which ways are compared: that of the target, and those of prefixes, 12 dB apart.
class ComparedSteps {
 public:
  /// plain: the way that others are held against. target: a step; 0 is to the last bit. samples: of
  /// the plane.
  ComparedSteps(const CostAtStep& plain, double target, double samples);

  /// How many times the bytes of equal quality a way takes: the geometric mean over prefixes, and
  /// beside it, as much as all of them, the target. more_bits: that it takes besides.
  double ratio(const CostAtStep& way, double more_bits) const;
  /// The same at the target alone.
  double ratioAtTarget(const CostAtStep& way, double more_bits) const;

 private:
  struct Plain {
    double step, bits, joint;
  };

  static double logRatio(const Plain& plain, const CostAtStep& way, double more_bits);

  std::vector<Plain> plain_;
};

}  // namespace tetrakis::inline choice
