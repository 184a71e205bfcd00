// SPDX-License-Identifier: Apache-2.0
// headerOf() codes a priority map as the part of the header that holds it.
#pragma once

#include "codec/wavelet/priority_map.hpp"

namespace tetrakis::inline wavelet {

/// The header that stands for a map; an empty one for a map without tiles.
PriorityHeader headerOf(const PriorityMap& map);

}  // namespace tetrakis::inline wavelet
