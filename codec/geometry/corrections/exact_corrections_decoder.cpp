// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/exact_corrections_decoder.hpp"

#include "bitstream/coder/decision_decoding.hpp"
#include "codec/geometry/corrections/exact_corrections.hpp"

namespace tetrakis::inline corrections {

void decodeExactSteps(std::span<const uint8_t> codeword, const PlaneView<const int32_t>& heights,
                      int fraction_bits, const TakeSteps& take) {
  DecisionDecoding reader(codeword);
  codeExactSteps(
      heights, fraction_bits, reader, [](size_t) { return 0; }, take);
}

}  // namespace tetrakis::inline corrections
