// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <cmath>

#include "base/portable_math.hpp"

namespace tetrakis::inline inputs {

namespace {

/// Bytes that each component codes behind the budget, or behind its part of it. More bytes show the
/// slopes behind the end of small budgets, and take time.
constexpr uint64_t kMargin = 4096;
/// The part of a budget that two components code beyond it; one component codes twice the budget. A
/// larger part takes time; with a smaller one the order of packets depends more on the budget.
constexpr uint64_t kSharedPart = 4;

}  // namespace

Purpose purposeOf(const EncodeInputs& inputs) {
  return inputs.options.lossless != 0 ? Purpose::kLossless : Purpose::kLossy;
}

uint64_t limitOf(const EncodeInputs& inputs) {
  const uint64_t budget = inputs.options.bytes;
  if (!inputs.budgeted() || budget >= UINT64_MAX / 4) return UINT64_MAX;
  const bool shared = inputs.heights != nullptr && inputs.image != nullptr;
  return budget + (shared ? budget / kSharedPart : budget) + kMargin;
}

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / portable::pow(10, psnr / 10);
}

}  // namespace tetrakis::inline inputs
