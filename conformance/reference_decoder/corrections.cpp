// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections of steps and of samples (docs/FORMAT.md, section 8.1).
#include "conformance/reference_decoder/numbers.hpp"

#include "conformance/reference_decoder/layers.hpp"

namespace tetrakis::reference {

std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Plane& plane,
                                        const std::vector<int>& hints) {
  RangeDecoder decoder(codeword);
  CorrectionDecoder corrections(decoder, plane);
  std::vector<uint32_t> decoded(plane.values.size(), 0);
  try {
    for (int y = 0; y < plane.height; ++y) {
      for (int x = 0; x < plane.width; ++x) {
        const size_t i = plane.index(x, y);
        if (plane.isValid(x, y)) decoded[i] = corrections.next(hints[i], x, y);
      }
    }
  } catch (Undecided) {
  }
  return decoded;
}

}  // namespace tetrakis::reference
