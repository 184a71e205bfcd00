// SPDX-License-Identifier: Apache-2.0
// Decodes a validity mask from a codeword.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

/// One byte a sample, row by row: 1 valid, 0 void. codeword: any prefix of a validity codeword;
/// none at all says that every sample is valid. Safe on any bytes.
std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, uint32_t width,
                                    uint32_t height);

}  // namespace tetrakis
