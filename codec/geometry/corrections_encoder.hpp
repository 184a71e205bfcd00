// SPDX-License-Identifier: Apache-2.0
// Corrections to codeword.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/corrections_pass.hpp"

namespace tetrakis {

/// corrections: width * height; those of void samples are not coded.
std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionGrid& grid);

}  // namespace tetrakis
