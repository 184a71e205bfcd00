// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_decoder.hpp"

#include <cassert>
#include <cstddef>

#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/corrections/exact_corrections.hpp"

namespace tetrakis::inline corrections {

std::vector<uint8_t> activityHints(std::span<const uint8_t> significant, Extent extent) {
  assert(significant.size() == extent.samples());
  const auto [width, height] = extent;
  std::vector<uint8_t> hints(significant.begin(), significant.end());
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (x > 0) hints[i] += significant[i - 1];
      if (x + 1 < width) hints[i] += significant[i + 1];
      if (y > 0) hints[i] += significant[i - width];
      if (y + 1 < height) hints[i] += significant[i + width];
    }
  }
  return hints;
}

void decodeCorrections(std::span<const uint8_t> codeword, const CorrectionHints& hints,
                       const TakeCorrections& take) {
  DecisionDecoding reader(codeword);
  codeCorrections(
      hints, reader, [](size_t) { return 0; }, take);
}

void decodeExactSteps(std::span<const uint8_t> codeword, const PlaneView<const int32_t>& heights,
                      int fraction_bits, const TakeSteps& take) {
  DecisionDecoding reader(codeword);
  codeExactSteps(
      heights, fraction_bits, reader, [](size_t) { return 0; }, take);
}

}  // namespace tetrakis::inline corrections
