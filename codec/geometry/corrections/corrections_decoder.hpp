// SPDX-License-Identifier: Apache-2.0
// Decodes the corrections of heights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/corrections/corrections_pass.hpp"

namespace tetrakis::inline corrections {

/// Returns one integer for each sample, modulo 2^32, which is 0 where the sample is void and where
/// the codeword ends early. codeword: any prefix of one that encodeCorrections() made. Safe on any
/// bytes.
std::vector<int32_t> decodeCorrections(std::span<const uint8_t> codeword,
                                       const CorrectionHints& hints);

}  // namespace tetrakis::inline corrections
