// SPDX-License-Identifier: Apache-2.0
// Writes a priority map down for a header.
#pragma once

#include "wavelet/priority_map.hpp"

namespace tetrakis::inline wavelet {

/// The header that stands for a map; an empty one for a map without tiles.
PriorityHeader headerOf(const PriorityMap& map);

}  // namespace tetrakis::inline wavelet
