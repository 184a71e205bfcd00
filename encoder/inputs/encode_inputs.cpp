// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <cmath>

#include "base/portable_math.hpp"

namespace tetrakis::inline inputs {

Purpose purposeOf(const EncodeInputs& inputs) {
  return inputs.options.lossless != 0 ? Purpose::kLossless : Purpose::kLossy;
}

uint64_t limitOf(const EncodeInputs& inputs) {
  constexpr uint64_t kMargin = 4096;
  const uint64_t budget = inputs.options.bytes;
  if (!inputs.budgeted() || budget >= UINT64_MAX / 4) return UINT64_MAX;
  const bool shared = inputs.heights != nullptr && inputs.image != nullptr;
  return budget + (shared ? budget / 4 : budget) + kMargin;
}

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / portable::pow(10, psnr / 10);
}

}  // namespace tetrakis::inline inputs
