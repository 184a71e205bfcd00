// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <cassert>
#include <cmath>

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
  return peak * peak / std::pow(10, psnr / 10);
}

Status reportProgress(const tks_encode_options& options, double done) {
  assert(done >= 0 && done <= 1);
  if (options.progress == nullptr || options.progress(options.user, done) == 0) return {};
  return {TKS_USAGE, "Encoding was stopped by the caller."};
}

}  // namespace tetrakis::inline inputs
