// SPDX-License-Identifier: Apache-2.0
// photographOf() separates a photograph from an overlay that somebody has drawn over it: lettering,
// boundaries, borders without data, water in one colour. A wavelet rings along all edges of an
// overlay; so its texels are drawn, and the wavelet lifts around them as around voids. An overlay
// lies ahead of all coefficients, so it has to save more bytes than prefixes lose by it. Encoder
// only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/texels.hpp"

namespace tetrakis::inline mask {

/// Returns one byte for each texel, which is 1 if it belongs to the photograph and 0 if it belongs
/// to the overlay; or nothing if no overlay is worth trying. Each colour of an overlay fills at
/// least 1/2000 of the texels, and half of those are like the texel before, or
/// three quarters like that or the one above. seen: the texels whose
/// colours matter; an overlay need not draw the others.
std::vector<uint8_t> photographOf(const Texels& texels, Mask seen = {});

}  // namespace tetrakis::inline mask
