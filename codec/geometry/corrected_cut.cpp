// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrected_cut.hpp"

#include <algorithm>
#include <span>

#include "codec/geometry/corrections/corrections_encoder.hpp"

namespace tetrakis::inline geometry {

int32_t nearestMultiple(int64_t q, int64_t largest) {
  const int64_t unit = 2 * largest + 1, shifted = q + largest;
  return static_cast<int32_t>((shifted - (shifted % unit + unit) % unit) / unit);
}

Corrected CorrectedCut::correct(uint64_t bytes) const {
  const DecodedGeometry decoded = decodeGeometry(
      header_, {std::span(coefficients_.codeword).first(bytes)}, {steps_.valid, flat_});
  const std::vector<int32_t> steps = wholeSteps(decoded);
  Corrected result;
  std::vector<int32_t> corrections(steps.size());
  bool any = false;
  for (size_t i = 0; i < corrections.size(); ++i) {
    const int64_t error = int64_t{steps_.steps[i]} - steps[i];
    corrections[i] = nearestMultiple(error, largest_);
    any |= corrections[i] != 0;
    const auto rest = static_cast<double>(error - int64_t{corrections[i]} * (2 * largest_ + 1));
    result.before += static_cast<double>(error) * static_cast<double>(error);
    result.after += rest * rest;
  }
  if (!any) return result;
  const std::vector<uint8_t> hints = activityHints(decoded);
  result.codeword = encodeCorrections(corrections, {hints, header_.extent(), steps_.valid});
  return result;
}

uint64_t CorrectedCut::bytesFor(double mean_square) const {
  const auto samples = static_cast<double>(steps_.validCount());
  for (const RatePoint& point : coefficients_.points) {
    if (point.distortion <= mean_square * samples) return point.bytes;
  }
  return coefficients_.codeword.size();
}

/// The bytes have one minimum, near the usual cut: descent from there with ever smaller strides.
/// Every turn but the last of each stride has fewer bytes than the one before.
uint64_t CorrectedCut::best() const {
  uint64_t best = bytesFor(usualCut(largest_)), least = total(best);
  for (const double stride : {1.3, 1.1, 1.04}) {
    for (const double factor : {1 / stride, stride}) {
      for (;;) {
        const uint64_t cut =
            std::min<uint64_t>(static_cast<uint64_t>(static_cast<double>(best) * factor),
                               coefficients_.codeword.size());
        const uint64_t bytes = total(cut);
        if (bytes >= least) break;
        best = cut;
        least = bytes;
      }
    }
  }
  return best;
}

}  // namespace tetrakis::inline geometry
