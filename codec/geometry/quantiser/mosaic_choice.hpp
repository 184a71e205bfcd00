// SPDX-License-Identifier: Apache-2.0
// Floats of several sources: some are whole metres, or decimetres, others anything between them. A
// step that shows all of them codes, for each whole one, bits of which it has none. A coarser step
// shows the whole ones, and corrections restore the others. Encoder only.
#pragma once

#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// fine: the steps that toSteps() has found, with corrections behind them where they are not exact.
/// Returns these, or coarser ones that about take clearly fewer bits to the last bit.
HeightSteps fewerBitsOfMosaic(const tks_heights& heights, HeightSteps fine);

}  // namespace tetrakis::inline quantiser
