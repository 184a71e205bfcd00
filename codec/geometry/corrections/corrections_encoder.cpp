// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_encoder.hpp"

#include <cassert>

#include "codec/geometry/corrections/correction_writer.hpp"

namespace tetrakis::inline corrections {

std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionHints& hints) {
  assert(corrections.size() == hints.extent().samples());
  CorrectionWriter writer;
  codeCorrections(
      hints, writer, [&](size_t sample) { return corrections[sample]; },
      [](size_t, std::span<const int32_t>) {});
  return writer.finish();
}

}  // namespace tetrakis::inline corrections
