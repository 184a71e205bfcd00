// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/compared_steps.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable_math.hpp"

namespace tetrakis::inline choice {

namespace {

/// Each step over the one before, 12 dB apart, and the first one behind a target to the last bit.
/// Closer steps judge prefixes more exactly, and take the time of an estimate each.
constexpr double kStepsApart = 4, kFirstLossy = 2;
/// Bits a sample of the shortest prefixes that are compared. A smaller number counts earlier
/// prefixes, whose estimates err more.
constexpr double kLeastPrefixBits = 0.05;
/// Ratios of bits below this one count as this. With a smaller number one step, at which a way
/// costs nothing, may decide alone.
constexpr double kLeastRatio = 0.05;

}  // namespace

ComparedSteps::ComparedSteps(const CostAtStep& plain, double target, double samples) {
  for (double step = target;; step = step == 0 ? kFirstLossy : kStepsApart * step) {
    const PlaneCost cost = plain(step);
    if (!plain_.empty() && cost.bits < kLeastPrefixBits * samples) return;
    plain_.push_back({step, cost.bits, cost.joint(step)});
  }
}

double ComparedSteps::ratio(const CostAtStep& way, double more_bits) const {
  const double target = logRatio(plain_.front(), way, more_bits);
  if (plain_.size() == 1) return portable::exp(target);
  double prefixes = 0;
  for (size_t i = 1; i < plain_.size(); ++i) prefixes += logRatio(plain_[i], way, more_bits);
  return portable::exp((target + prefixes / static_cast<double>(plain_.size() - 1)) / 2);
}

double ComparedSteps::ratioAtTarget(const CostAtStep& way, double more_bits) const {
  return portable::exp(logRatio(plain_.front(), way, more_bits));
}

double ComparedSteps::logRatio(const Plain& plain, const CostAtStep& way, double more_bits) {
  const double change = way(plain.step).joint(plain.step) + more_bits - plain.joint;
  return portable::log(std::max(1 + change / plain.bits, kLeastRatio));
}

}  // namespace tetrakis::inline choice
