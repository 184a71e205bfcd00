// SPDX-License-Identifier: Apache-2.0
// Two kinds of floats have better steps than the one that shows their samples. Files of several
// sources have samples that are whole metres, or decimetres, beside any others: a step that shows
// all of them codes, for each whole one, bits of which it has none. A coarser step shows the whole
// ones, and corrections restore the others. And floats that are smooth to their last bits, which no
// step shows, take fewer bits as coefficients of a finer step than as corrections. Encoder only.
#pragma once

#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// found: the steps that toSteps() has found, with corrections behind them where they are not
/// exact. Returns these, or coarser or finer ones that by the estimate clearly take fewer bits.
HeightSteps fewerBitsByOtherSteps(const tks_heights& heights, HeightSteps found);

}  // namespace tetrakis::inline quantiser
