// SPDX-License-Identifier: Apache-2.0
// encodeStoredHeights() writes the samples of heights without coding them, where no coder takes
// fewer bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline geometry {

/// Returns how many bytes storing the valid samples takes.
uint64_t storedBytes(const tks_heights& heights, size_t valid_samples);

/// Returns the codeword of the valid samples.
std::vector<uint8_t> encodeStoredHeights(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline geometry
