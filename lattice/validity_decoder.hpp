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

}  // namespace tetrakis::inline lattice
