// SPDX-License-Identifier: Apache-2.0
// Decodes the corrections of heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/corrections/corrections_pass.hpp"

namespace tetrakis::inline corrections {

/// One integer for each sample, modulo 2^32, which is 0 where the sample is void and where the
/// codeword ends early: from sample `decided` on, row by row.
struct DecodedCorrections {
  std::vector<int32_t> values;
  size_t decided = 0;
};

/// codeword: any prefix of one that encodeCorrections() made. Safe on any
/// bytes.
DecodedCorrections decodeCorrections(std::span<const uint8_t> codeword,
                                     const CorrectionHints& hints);

}  // namespace tetrakis::inline corrections
