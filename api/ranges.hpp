// SPDX-License-Identifier: Apache-2.0
// giveRanges() copies ranges of bytes into a list that the caller releases.
#pragma once

#include <span>

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Copies ranges to where tks_free_ranges() finds them. out: has none.
void giveRanges(std::span<const tks_range> ranges, tks_ranges& out);

}  // namespace tetrakis::inline api
