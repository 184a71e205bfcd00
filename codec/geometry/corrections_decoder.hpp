// SPDX-License-Identifier: Apache-2.0
// Codeword to corrections.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/corrections_pass.hpp"

namespace tetrakis {

/// One integer a sample, modulo 2^32; 0 where voids are and where the codeword ends early.
/// codeword: any prefix of one that encodeCorrections made. Safe on any bytes.
std::vector<int32_t> decodeCorrections(std::span<const uint8_t> codeword,
                                       const CorrectionGrid& grid);

}  // namespace tetrakis
