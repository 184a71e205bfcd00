// SPDX-License-Identifier: Apache-2.0
// Encodes a validity mask as a codeword.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

/// valid: width * height, row by row, 1 valid, 0 void. At least one byte. The whole codeword gives
/// the mask back whatever bytes follow it.
std::vector<uint8_t> encodeValidity(std::span<const uint8_t> valid, uint32_t width,
                                    uint32_t height);

}  // namespace tetrakis
