// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_decoder.hpp"

#include "codec/geometry/corrections/correction_reader.hpp"

namespace tetrakis::inline corrections {

void decodeCorrections(std::span<const uint8_t> codeword, const CorrectionHints& hints,
                       const TakeCorrections& take) {
  CorrectionReader reader(codeword);
  codeCorrections(
      hints, reader, [](size_t) { return 0; }, take);
}

}  // namespace tetrakis::inline corrections
