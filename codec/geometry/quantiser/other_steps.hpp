// SPDX-License-Identifier: Apache-2.0
// fewerBitsByOtherSteps() tries a coarser and a finer step than the one that shows all samples.
// Files that join several sources have samples of whole metres, or decimetres, beside any others: a
// step that shows all samples codes bits that the whole ones do not have. A coarser step shows the
// whole ones, and corrections restore the others. Floats that are smooth to their last bits, which
// no step shows, take fewer bits as coefficients of a finer step than as corrections. Encoder only.
#pragma once

#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// found: the steps of toSteps(), with corrections behind them where they are not exact. Returns
/// these steps, or coarser or finer ones that by the estimate clearly take fewer bits.
HeightSteps fewerBitsByOtherSteps(const tks_heights& heights, HeightSteps found);

}  // namespace tetrakis::inline quantiser
