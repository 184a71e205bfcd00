// SPDX-License-Identifier: Apache-2.0
// Encoders look at typical parts of a plane before they code all of it.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"

namespace tetrakis::inline wavelet {

/// Returns the parts that stand for a plane where trying all of it would take too long: the whole
/// plane if neither side is above 256. Otherwise there is a part in the middle of each field of a
/// grid of 3 by 3, with at most `side` samples along each side, because a single part may be water,
/// or a lawn.
std::vector<Window> typicalParts(Extent plane, uint32_t side = 96);

}  // namespace tetrakis::inline wavelet
