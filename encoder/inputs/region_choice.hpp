// SPDX-License-Identifier: Apache-2.0
// chooseRegions() decides whether a component is coded in regions (bitstream/track/regions.hpp),
// and how large they are, from its size and the caller's options.
#pragma once

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline inputs {

/// The largest number of heights in one region; more lie in several regions unless the caller says
/// otherwise. A larger number saves more planes the bytes that regions cost, and their windows take
/// the whole plane.
inline constexpr uint64_t kOneRegionHeights = 1025 * 1025;

struct RegionChoice {
  int side_log2 = 0;     ///< 0: one region
  bool windows = false;  ///< the stream is made to be read by windows of it
};

/// large: planes of the size of this one are coded in regions unless the caller says otherwise; for
/// windows all planes are.
RegionChoice chooseRegions(const tks_encode_options& options, Extent plane, bool large);

}  // namespace tetrakis::inline inputs
