// SPDX-License-Identifier: Apache-2.0
#include "codec/polyline/algorithms.hpp"

namespace tetrakis::inline polyline {

const std::array<Algorithm, 8> kAlgorithms = {{
    {"uoptimal", uoptimal, 0, false, false},
    {"urefine", urefine, 3, true, false},
    {"udecimate", udecimate, 5, true, false},
    {"udecimate-global", udecimateGlobal, 5, true, false},
    {"crefine", crefine, 1, true, true},
    {"cdecimate", cdecimate, 1, true, true},
    {"cglobal", cglobal, 5, true, true},
    {"coptimal", coptimal, 7, true, true},
}};

}  // namespace tetrakis::inline polyline
