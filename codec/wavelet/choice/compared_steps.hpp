// SPDX-License-Identifier: Apache-2.0
// ComparedSteps compares two ways to code one plane, at the step of the target and at coarser
// steps, because every prefix of a stream is a stream. Encoder only.
#pragma once

#include <functional>
#include <vector>

#include "codec/wavelet/choice/plane_cost.hpp"

namespace tetrakis::inline choice {

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
