// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections of steps and of samples (docs/FORMAT.md, section 8.1).
#include "conformance/reference_decoder/corrections.hpp"

#include "conformance/reference_decoder/layers.hpp"

namespace tetrakis::reference {

std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Plane& plane,
                                        const std::vector<int>& hints) {
  RangeDecoder decoder(codeword);
  CorrectionDecoder corrections(decoder, plane);
  std::vector<uint32_t> decoded(plane.values.size(), 0);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      if (!plane.isValid(x, y)) continue;
      const size_t i = static_cast<size_t>(y) * plane.width + x;
      const std::optional<uint32_t> correction = corrections.next(hints[i], x, y);
      if (!correction) return decoded;
      decoded[i] = *correction;
    }
  }
  return decoded;
}

}  // namespace tetrakis::reference
