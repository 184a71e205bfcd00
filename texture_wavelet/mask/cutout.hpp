// SPDX-License-Identifier: Apache-2.0
// Images of which every texel is either opaque or not there: signs, trees, coasts. Encoder only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/texels.hpp"

namespace tetrakis {

/// One byte a texel, 1 where alpha has the largest value, 0 where it is 0; empty if alpha has
/// another value, or the largest one everywhere.
std::vector<uint8_t> cutoutOf(const Texels& texels);

/// Gives the colours of texels that are not coded the mean of the others, or 0 if there are none.
/// planes: the colours. coded: 1 for each texel that is.
void hideColours(std::span<const uint8_t> coded, std::vector<std::vector<int32_t>>& planes);

/// Samples that count in errors: all, or with a mask of the texels that are seen the alphas and the
/// colours of those.
uint64_t countedSamples(const Texels& texels, std::span<const uint8_t> seen);

/// Sum of the squared errors of the samples that count. Both images have the same shape.
double countedSquares(const Texels& original, const Texels& decoded, std::span<const uint8_t> seen);

}  // namespace tetrakis
