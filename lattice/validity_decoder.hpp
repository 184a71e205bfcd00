// SPDX-License-Identifier: Apache-2.0
// Decodes a validity mask from a codeword.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline lattice {

/// Returns one byte for each sample of the plane, row by row, which is 1 where the sample is valid
/// and 0 where it is void. codeword: any prefix of a validity codeword; an empty one says that
/// every sample is valid. Safe on any bytes.
std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, Extent plane);

/// The same of a mask that comes late, when it is known which samples are lifted: all others are
/// void. Lifted samples of which the codeword does not tell are taken to be valid.
std::vector<uint8_t> decodeLateValidity(std::span<const uint8_t> codeword, Extent plane,
                                        Mask lifted);

}  // namespace tetrakis::inline lattice
