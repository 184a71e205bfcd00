// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_encoder.hpp"

#include <cassert>

#include "bitstream/coder/range_encoder.hpp"
#include "codec/geometry/corrections/exact_corrections.hpp"

namespace tetrakis::inline corrections {

std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionHints& hints) {
  assert(corrections.size() == hints.extent().samples());
  DecisionEncoding writer;
  codeCorrections(
      hints, writer, [&](size_t sample) { return corrections[sample]; },
      [](size_t, std::span<const int32_t>) {});
  return writer.finish();
}

std::vector<uint8_t> encodeExactSteps(std::span<const int32_t> steps,
                                      const PlaneView<const int32_t>& heights, int fraction_bits) {
  assert(steps.size() == heights.extent().samples());
  DecisionEncoding writer;
  codeExactSteps(
      heights, fraction_bits, writer, [&](size_t sample) { return steps[sample]; },
      [](size_t, std::span<const int32_t>) {});
  return writer.finish();
}

}  // namespace tetrakis::inline corrections
