// SPDX-License-Identifier: Apache-2.0
// findRelativeStep() finds the relative step of floats (relative_prediction.hpp) from the distances
// by which samples miss the prediction of their neighbours: jumps gather at multiples of the step.
// Ground of triangles is smooth between jumps of any size; there a small part of the jumps is the
// step.
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
