// SPDX-License-Identifier: Apache-2.0
#include "encoder/targets/heights_need.hpp"

#include <algorithm>

#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/heights/height_errors.hpp"
#include "ratecontrol/needs/needed_bytes.hpp"

namespace tetrakis::inline targets {

std::optional<uint64_t> heightsNeed(const EncodeInputs& inputs, const HeightsCandidate& heights) {
  const CodedHeights& coded = *heights.coded;
  const SampleRange range = rangeOf(*inputs.heights, coded.quantised->steps.valid);
  const double worst = worstMeanSquare(range.high - range.low, inputs.options.psnr);
  const auto& packets = heights.curve->packets;
  // The last bytes of a mask may change nothing, and then there are none of them.
  const Codewords all = prefixAfter(coded.accounted(), packets, payloadOf(packets));
  const uint64_t masked = std::min<uint64_t>(coded.layers.maskEnd(), all.front().size());
  return leastBytes(packets, [&](uint64_t bytes) {
    const Codewords prefix = prefixAfter(coded.accounted(), packets, bytes);
    if (prefix.front().size() < masked) return false;
    const SampleErrors errors = sampleErrorsOf(coded, prefix, inputs.options.threads);
    return errors.mean_square * inputs.heaviest() <= worst;
  });
}

}  // namespace tetrakis::inline targets
