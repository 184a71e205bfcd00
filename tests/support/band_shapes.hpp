// SPDX-License-Identifier: Apache-2.0
// Bands with whole and with partial words and blocks.
#pragma once

#include "bitstream/track/band.hpp"

namespace tetrakis::test {

inline constexpr BandShape kBandShapes[] = {{1, 1},  {1, 31}, {3, 32}, {9, 33},  {8, 64},
                                            {17, 5}, {2, 97}, {40, 1}, {33, 70}, {16, 128}};

}  // namespace tetrakis::test
