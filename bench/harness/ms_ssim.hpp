// SPDX-License-Identifier: Apache-2.0
// Multi-scale structural similarity (Z. Wang, E. P. Simoncelli, A. C. Bovik, Asilomar 2003) of the
// luma of two images of 8 bits.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/raster.hpp"

namespace tetrakis::bench {

/// 1: equal. decoded: as many values as raster.samples. Sides from 176 samples, else fewer than the
/// five scales fit the window and they are left out.
double msSsim(const Raster& raster, const std::vector<uint16_t>& decoded);

}  // namespace tetrakis::bench
