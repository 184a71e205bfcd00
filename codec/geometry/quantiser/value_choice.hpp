// SPDX-License-Identifier: Apache-2.0
// fewerBits() decides whether a table of values takes fewer bits than multiples of a step. Encoder
// only.
#pragma once

#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// multiples: the steps of toSteps() for the heights, with corrections behind them where they are
/// not exact. Returns these, or places in a table of values. A few rare values may be missing in
/// the table: then it is not exact, and corrections restore their samples.
HeightSteps fewerBits(const tks_heights& heights, HeightSteps multiples);

}  // namespace tetrakis::inline quantiser
