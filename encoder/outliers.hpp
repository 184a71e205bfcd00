// SPDX-License-Identifier: Apache-2.0
// This file finds samples that lie so far from all others that they are no heights, though they are
// not the declared nodata value.
#pragma once

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline encoder {

/// See tks_find_outliers. The heights are checked.
tks_outliers findOutliers(const tks_heights& heights);

}  // namespace tetrakis::inline encoder
