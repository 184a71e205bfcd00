// SPDX-License-Identifier: Apache-2.0
// findOutliers() finds samples that lie so far from all others that they cannot be heights, though
// the file does not declare their value as nodata. Coded as heights they would cost most of the
// bytes.
#pragma once

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline encoder {

/// See tks_find_outliers. The heights are checked.
tks_outliers findOutliers(const tks_heights& heights);

}  // namespace tetrakis::inline encoder
