// SPDX-License-Identifier: Apache-2.0
// Finds the relative step of floats.
#pragma once

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline relative {

/// The step whose multiples nearly all samples lie beside what their neighbours predict, and which
/// is much wider than the distance of neighbouring floats; 0 if there is none. On ground that is
/// smooth between edges it is a part of the jumps there, and may be of no use. Of large planes a
/// part is looked at.
double findRelativeStep(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline relative
