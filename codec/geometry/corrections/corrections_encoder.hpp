// SPDX-License-Identifier: Apache-2.0
// encodeCorrections() codes one small integer for each sample as a codeword of corrections
// (corrections_pass.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/corrections/corrections_pass.hpp"

namespace tetrakis::inline corrections {

/// Returns the codeword of one correction for each sample. Those of void samples are not coded.
std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionHints& hints);

}  // namespace tetrakis::inline corrections
