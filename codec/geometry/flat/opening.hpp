// SPDX-License-Identifier: Apache-2.0
// Opening of a mask by a square (J. Serra 1982): what is left is all that squares inside the mask
// cover. Bays, straits and thin tongues go, so that the shape takes few bytes, and every marked
// sample stays one of the mask. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline flat {

/// marks: 0 or 1, of each sample of the plane. The squares have sides of 2 reach + 1 samples;
/// beyond the border all is marked.
void openMask(std::vector<uint8_t>& marks, Extent plane, uint32_t reach);

}  // namespace tetrakis::inline flat
